// SPDX-License-Identifier: Apache-2.0
#include <tools/host_module/doctor.h>
#include <tools/host_module/host_sink.h>

#include <OpenImageIO/imageio.h>

namespace osio::host {

namespace {

class OpenImageIoModule final : public HostModule {
  public:
    [[nodiscard]] Result<std::unique_ptr<HostSink>> open_sink(const HostImage& image) const override {
        return open_host_sink(image);
    }

    [[nodiscard]] Result<std::vector<std::string>> channel_order(const std::string& path,
                                                                 std::size_t part) const override {
        const auto input = OIIO::ImageInput::create("openexr");
        OIIO::ImageSpec spec;
        if (!input || !input->open(path, spec) || !input->seek_subimage(static_cast<int>(part), 0))
            return fail(ErrorCode::Io,
                        "OpenImageIO cannot read it: " + (input ? input->geterror() : OIIO::geterror()),
                        path);
        return input->spec(static_cast<int>(part)).channelnames;
    }

    [[nodiscard]] std::vector<Finding> examine(const std::string& plugin_folder) const override {
        return examine_host(plugin_folder);
    }
};

}  // namespace

}  // namespace osio::host

extern "C" __attribute__((visibility("default"))) const osio::host::HostModule* osio_host_module();

const osio::host::HostModule* osio_host_module() {
    static const osio::host::OpenImageIoModule module;
    return &module;
}
