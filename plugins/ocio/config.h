// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/output_resolver.h>

#include <OpenColorIO/OpenColorIO.h>
#include <optional>
#include <string>

namespace osio::ocio {

namespace OCIO = OCIO_NAMESPACE;

/// A config of OpenColorIO's. Scene-referred spaces and views are entered from the space of its role
/// aces_interchange, in which ACES2065-1 is written; display-referred spaces from that of
/// cie_xyz_d65_interchange.
class OcioConfig final : public ColourConfig {
  public:
    OcioConfig(std::string file, OCIO::ConstConfigRcPtr config)
        : m_file(std::move(file)), m_config(std::move(config)) {}

    [[nodiscard]] std::string file() const override { return m_file; }

    [[nodiscard]] std::string name() const override;
    [[nodiscard]] std::vector<ConfigName> names() const override;
    [[nodiscard]] Result<OutputSpace> find(std::string_view name) const override;

  private:
    /// A display and one of its views, in the config's spelling.
    struct View {
        std::string display;
        std::string view;
        std::string color_space;  ///< in which the display's pixels are
    };

    [[nodiscard]] std::vector<View> views() const;
    [[nodiscard]] std::optional<View> find_view(std::string_view name) const;
    [[nodiscard]] Result<OutputSpace> to_space(const OCIO::ConstColorSpaceRcPtr& space) const;
    [[nodiscard]] Result<OutputSpace> to_view(const View& view) const;
    [[nodiscard]] Result<std::string> interchange(const char* role) const;
    [[nodiscard]] TransformSource source(std::string from) const;
    [[nodiscard]] tl::unexpected<Error> refuse(const std::string& why) const;

    std::string m_file;
    OCIO::ConstConfigRcPtr m_config;
};

}  // namespace osio::ocio
