// SPDX-License-Identifier: Apache-2.0
#include <tools/host_module/doctor.h>
#include <tools/host_module/host_sink.h>

namespace osio::host {

namespace {

class OpenImageIoModule final : public HostModule {
  public:
    [[nodiscard]] Result<std::unique_ptr<HostSink>> open_sink(const HostImage& image) const override {
        return open_host_sink(image);
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
