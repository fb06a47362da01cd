// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/text_loader.h>

namespace osio {

Result<Illuminant> load_illuminant(const std::string& name, const TextLoader& load_text) {
    if (!is_table_path(name))
        return find_illuminant(name);
    OSIO_TRY(const std::string csv, load_text(name));
    return illuminant_from_csv(csv, name);
}

Result<BandMap> load_band_map(const std::string& words, const TextLoader& load_text) {
    if (!is_table_path(words))
        return parse_band_steps(words);
    OSIO_TRY(const std::string csv, load_text(words));
    return parse_band_table(csv, words);
}

Result<OpenWords> load_open_words(const CollapseRequest& request, const TextLoader& load_text) {
    OpenWords out;
    out.quantity = request.quantity;
    if (!request.wavelengths.empty()) {
        OSIO_TRY(out.wavelengths, load_band_map(request.wavelengths, load_text));
    }
    return out;
}

}  // namespace osio
