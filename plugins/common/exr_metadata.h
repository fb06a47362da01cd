// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenImageIO/imageio.h>

/// Header attributes of OpenEXR as metadata of OpenImageIO and back, under the names that OIIO's own
/// OpenEXR reader and writer use, so that a file read by one and written by the other keeps them.
namespace osio::plugin {

/// Adds every attribute that OIIO can hold; of unknown types the bytes, so that our writer can give
/// them back. Leaves out what describes the file's structure.
void add_metadata(const Imf::Header& header, OIIO::ImageSpec& spec);

/// Inserts the spec's metadata into a header. Leaves out OIIO's own notes (`oiio:`), those of other
/// formats (`png:` and the like) and what describes the file's structure.
void insert_metadata(const OIIO::ImageSpec& spec, Imf::Header& header);

}  // namespace osio::plugin
