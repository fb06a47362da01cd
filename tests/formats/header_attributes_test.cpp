// SPDX-License-Identifier: Apache-2.0
#include <formats/image/header_attributes.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

namespace osio::image {
namespace {

TEST(HeaderAttributes, ErasedAreGoneAndTheOthersAreAsTheyWere) {
    Imf::Header header({{0, 0}, {9, 9}}, {{1, 2}, {7, 8}});
    header.compression() = Imf::DWAA_COMPRESSION;
    header.dwaCompressionLevel() = 12;
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.insert("kept", Imf::StringAttribute("a text that is too long to be held in place"));
    header.insert("gone", Imf::StringAttribute("another text that is too long to be held in place"));
    header.insert("number", Imf::IntAttribute(7));

    erase_attributes({"gone", "number", "never there"}, header);

    EXPECT_EQ(header.find("gone"), header.end());
    EXPECT_EQ(header.find("number"), header.end());
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("kept").value(),
              "a text that is too long to be held in place");
    EXPECT_EQ(header.dataWindow(), Imath::Box2i({1, 2}, {7, 8}));
    EXPECT_EQ(header.displayWindow(), Imath::Box2i({0, 0}, {9, 9}));
    EXPECT_EQ(header.compression(), Imf::DWAA_COMPRESSION);
    EXPECT_EQ(header.dwaCompressionLevel(), 12);
    EXPECT_NE(header.channels().findChannel("Y"), nullptr);
}

}  // namespace
}  // namespace osio::image
