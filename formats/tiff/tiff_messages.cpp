// SPDX-License-Identifier: Apache-2.0
#include <formats/image/limits.h>
#include <formats/tiff/tiff_messages.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <memory>

namespace osio::tiff {

namespace {

/// Words beyond are those of a file that repeats a mistake for each of its tags.
constexpr std::size_t kMostWarnings = 16;

std::string text_of(const char* format, va_list arguments) {
    std::array<char, 512> text{};
    const int length = std::vsnprintf(text.data(), text.size(), format, arguments);
    std::string out(text.data(),
                    length < 0 ? 0 : std::min(static_cast<std::size_t>(length), text.size() - 1));
    // Where the words start with the file's name: handles have none, errors name the file themselves.
    if (out.starts_with(": "))
        out.erase(0, 2);
    while (!out.empty() && (out.back() == '.' || out.back() == '\n'))
        out.pop_back();
    return out;
}

int keep_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
    auto& messages = *static_cast<Messages*>(user);
    if (messages.error.empty())
        messages.error = text_of(format, arguments);
    return 1;
}

int keep_warning(TIFF*, void* user, const char*, const char* format, va_list arguments) {
    auto& messages = *static_cast<Messages*>(user);
    std::string text = text_of(format, arguments);
    // The tags of GDAL, of cameras and of everyone else.
    if (!text.starts_with("Unknown field with tag") && messages.warnings.size() < kMostWarnings)
        messages.warnings.push_back(std::move(text));
    return 1;
}

int close_nothing(void*) {
    return 0;
}

}  // namespace

TIFF* Messages::open(const char* mode, void* client, TIFFReadWriteProc read, TIFFReadWriteProc write,
                     TIFFSeekProc seek, TIFFSizeProc size) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               &TIFFOpenOptionsFree);
    if (!options)
        return nullptr;
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &keep_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &keep_warning, this);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(image::kMostBlockBytes));
    return TIFFClientOpenExt("", mode, client, read, write, seek, &close_nothing, size, nullptr, nullptr,
                             options.get());
}

}  // namespace osio::tiff
