// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/request.h>

#include <OpenImageIO/imageio.h>

#include <string>
#include <string_view>

/// How a host's file name and hints become a file and a request.
namespace osio::plugin {

/// What to open and how.
struct OpenRequest {
    std::string path;         ///< of any format that image::open_image() reads
    CollapseRequest request;  ///< paths of tables are absolute or seen from the current folder
};

/// The three ways in: `shot.exr?to=lin_rec709&illuminant=D65` on any name, a `.spectral` recipe, our
/// own extension `.spexr`.
enum class NameKind {
    Query,   ///< has a `?`, and no file has that very name
    Recipe,  ///< ends in .spectral
    Own,     ///< ends in .spexr
    Other,   ///< anything else: the host's own readers come first
};

[[nodiscard]] NameKind kind_of(const std::string& name);

/// Reads the choices, later ones over earlier ones: recipe, `spectral:KEY` hints of `config` (may be
/// null), query. Fails on a word that nobody knows and on a recipe that cannot be read.
[[nodiscard]] Result<OpenRequest> resolve_open(const std::string& name, const OIIO::ImageSpec* config);

/// True where the name is ours and the file behind it looks like one; cheap and silent.
[[nodiscard]] bool names_our_file(const std::string& name);

/// True where a host's hints ask for spectral treatment.
[[nodiscard]] bool has_spectral_hint(const OIIO::ImageSpec& config);

/// Reads a recipe: lines `key = value` with the words of request_options() and `source`, the image's
/// file; `#` starts a comment. Paths are seen from the recipe's folder.
[[nodiscard]] Result<OpenRequest> read_recipe(const std::string& path);

}  // namespace osio::plugin
