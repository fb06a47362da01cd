// SPDX-License-Identifier: Apache-2.0
//
// Loaded before a program (LD_PRELOAD), makes one call of the system fail that has to do with files of
// one folder: OSIO_FAULT_UNDER names the folder, OSIO_FAULT_CALL the call, OSIO_FAULT_AT its number from 0,
// OSIO_FAULT_ERRNO the error. Each call that was counted adds a line to the file OSIO_FAULT_LOG.
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <unistd.h>

namespace {

std::string_view setting(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view() : value;
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool watched(std::string_view path) {
    const std::string_view folder = setting("OSIO_FAULT_UNDER");
    return !folder.empty() && path.starts_with(folder) &&
           (path.size() == folder.size() || path.ends_with(".tmp"));
}

bool watched(int descriptor) {
    std::array<char, 4096> path{};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t length = ::readlink(link.c_str(), path.data(), path.size());
    return length > 0 && watched(std::string_view(path.data(), static_cast<std::size_t>(length)));
}

void log(std::string_view call) {
    const std::string line = std::string(call) + "\n";
    const int out =
        ::open(std::string(setting("OSIO_FAULT_LOG")).c_str(), O_WRONLY | O_APPEND | O_CREAT, 0666);
    if (out < 0)
        return;
    static auto* const write_next = next<ssize_t(int, const void*, std::size_t)>("write");
    write_next(out, line.data(), line.size());
    static auto* const close_next = next<int(int)>("close");
    close_next(out);
}

/// True where this call is the one that shall fail; errno is set.
bool fails(std::string_view call) {
    static std::atomic<int> count{0};
    log(call);
    if (setting("OSIO_FAULT_CALL") != call)
        return false;
    if (std::to_string(count++) != setting("OSIO_FAULT_AT"))
        return false;
    errno = setting("OSIO_FAULT_ERRNO") == "ENOSPC" ? ENOSPC : EIO;
    return true;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) ssize_t write(int descriptor, const void* bytes, std::size_t count) {
    static auto* const real = next<ssize_t(int, const void*, std::size_t)>("write");
    return watched(descriptor) && fails("write") ? -1 : real(descriptor, bytes, count);
}

__attribute__((visibility("default"))) ssize_t pwrite(int descriptor, const void* bytes, std::size_t count,
                                                      off_t at) {
    static auto* const real = next<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
    return watched(descriptor) && fails("pwrite") ? -1 : real(descriptor, bytes, count, at);
}

__attribute__((visibility("default"))) int fsync(int descriptor) {
    static auto* const real = next<int(int)>("fsync");
    return watched(descriptor) && fails("fsync") ? -1 : real(descriptor);
}

__attribute__((visibility("default"))) int close(int descriptor) {
    static auto* const real = next<int(int)>("close");
    // Closing what was only read loses nothing.
    const bool writes = (::fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
    const bool fail = writes && watched(descriptor) && fails("close");
    const int code = errno;
    const int result = real(descriptor);
    errno = fail ? code : errno;
    return fail ? -1 : result;
}

__attribute__((visibility("default"))) int rename(const char* from, const char* to) noexcept {
    static auto* const real = next<int(const char*, const char*)>("rename");
    return watched(from) && fails("rename") ? -1 : real(from, to);
}

}  // extern "C"
