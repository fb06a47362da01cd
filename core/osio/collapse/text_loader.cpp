// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/request.h>
#include <osio/collapse/text_loader.h>

namespace osio {

Result<Illuminant> load_illuminant(const std::string& name, const TextLoader& load_text) {
    if (!is_table_path(name))
        return find_illuminant(name);
    OSIO_TRY(const std::string csv, load_text(name));
    return illuminant_from_csv(csv, name);
}

}  // namespace osio
