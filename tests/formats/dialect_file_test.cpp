// SPDX-License-Identifier: Apache-2.0
//
// A file in a dialect and the file of the spectral EXR layout with the same meaning have the same weights and the
// same samples, so that whatever is made of them is the same.
#include <formats/files/text_file.h>
#include <formats/image/collapse_job.h>
#include <formats/image/open_image.h>

#include <osio/base/text.h>
#include <osio/collapse/kernel.h>

#include <support/exr_files.h>
#include <support/sets.h>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace osio::image {
namespace {

using test::request_of;
using test::smooth;
using test::TestChannel;
using test::TestFolder;
using test::TestPart;

using Attributes = std::function<void(Imf::Header&)>;

struct Twin {
    std::string what;
    std::vector<std::string> names;  ///< in the dialect, by wavelength
    Attributes attributes;
    std::vector<std::string> meaning;  ///< in the layout, in the same order
    Attributes said;                   ///< what the layout's file says beside
    double scale = 1;
    std::string words = {};  ///< for the dialect's file only
};

Imf::StringAttribute text(const std::string& value) {
    return Imf::StringAttribute(value);
}

std::string padded(int number, int digits) {
    std::string out = std::to_string(number);
    return std::string(static_cast<std::size_t>(digits) - out.size(), '0') + out;
}

constexpr int kBands = 12;

std::vector<Twin> twins() {
    std::vector<Twin> out(8);
    out[0] = {"Mitsuba", {}, {}, {}, [](Imf::Header& h) {
                  std::string edges;
                  for (int i = 0; i <= kBands; ++i)
                      edges += (i ? ";" : "") + std::to_string(395 + 30 * i);
                  h.insert("spectral:binEdges", text(edges));
              }};
    out[1] = {"layer of Mitsuba", {}, {}, {}, out[0].said};
    out[2] = {"Indigo",
              {},
              {},
              {},
              [](Imf::Header& h) {
                  std::string edges;
                  for (int i = 0; i <= kBands; ++i)
                      edges += (i ? ";" : "") + format_double(380 + 30.25 * i);
                  h.insert("spectral:binEdges", text(edges));
              },
              1e-9};
    out[3] = {"ISET3D", {}, {}, {}, {}};
    out[4] = {"Ocean",
              {},
              [](Imf::Header& h) {
                  for (int i = 0; i < kBands; ++i) {
                      const double metres = (400 + 25 * i) * 1e-9;
                      const std::string name = "wl" + padded(i, 2) + ".wavelength";
                      if (i % 2)
                          h.insert(name, Imf::FloatAttribute(static_cast<float>(metres)));
                      else
                          h.insert(name, Imf::DoubleAttribute(metres));
                  }
              },
              {},
              {}};
    out[5] = {"GDAL",
              {},
              [](Imf::Header& h) {
                  for (int i = 0; i < kBands; ++i)
                      h.insert("gdal:Band_" + std::to_string(i + 1),
                               text(format_double(400.5 + 25 * i) + " nm"));
              },
              {},
              {}};
    out[6] = {"a wavelength in names", {}, {}, {}, {}, 1, "&quantity=radiance"};
    out[7] = {"OpenCV", {}, {}, {}, {}, 1, "&wavelengths=400:25:675&quantity=radiance"};
    for (int i = 0; i < kBands; ++i) {
        const std::string low = std::to_string(395 + 30 * i), high = std::to_string(425 + 30 * i);
        const std::string bin = low + ".00-" + high + ".00nm", middle = std::to_string(410 + 30 * i) + "nm";
        std::string bucket = format_double(380 + 30.25 * i), centre = format_double(395.125 + 30.25 * i);
        std::replace(bucket.begin(), bucket.end(), '.', '_');
        std::replace(centre.begin(), centre.end(), '.', ',');
        const std::string nm = std::to_string(400 + 25 * i);
        out[0].names.push_back(bin);
        out[0].meaning.push_back("S0." + middle);
        out[1].names.push_back("direct." + bin);
        out[1].meaning.push_back("direct.S0." + middle);
        out[2].names.push_back("wavelength" + bucket);
        out[2].meaning.push_back("S0." + centre + "nm");
        out[3].names.push_back("Radiance.C" + padded(i + 1, 2));
        out[3].meaning.push_back("S0." + std::to_string(400 + 10 * i) + "nm");
        out[4].names.push_back("wl" + padded(i, 2));
        out[4].meaning.push_back("T." + nm + "nm");
        out[5].names.push_back("Band" + std::to_string(i + 1));
        out[5].meaning.push_back("T." + nm + ",5nm");
        out[6].names.push_back("b_" + nm + "nm");
        out[6].meaning.push_back("S0." + nm + "nm");
        out[7].names.push_back(std::to_string(i));
        out[7].meaning.push_back("S0." + nm + "nm");
    }
    return out;
}

/// Half in the dialect, of numbers as Indigo's are; float in the layout.
TestPart part_of(const std::vector<std::string>& names, Imf::PixelType type, double scale,
                 const Attributes& attributes) {
    std::vector<TestChannel> channels;
    for (const std::string& name : names)
        channels.push_back({name, type});
    TestPart part{channels};
    part.data_window = {{2, 3}, {12, 40}};
    part.attributes = attributes;
    part.pattern = [scale](std::size_t c, int x, int y) {
        return static_cast<double>(Imath::half(static_cast<float>(1000 * smooth(c, x, y)))) * scale;
    };
    return part;
}

/// The samples of a job's bands, band by band.
std::vector<double> samples_of(const CollapseJob& job) {
    PlaneChannels planes;
    for (const PlanColumn& band : job.plan.columns)
        planes.emplace_back(band.channel);
    const auto source = job.file->make_block_source(job.part_index, planes, Grain::Block).value();
    const auto reader = source->start_reader().value();
    const auto height = static_cast<std::size_t>(job.part().data_window.height());
    const auto width = static_cast<std::size_t>(job.part().data_window.width());
    std::vector<double> out(planes.size() * height * width);
    for (std::size_t index = 0; index < source->block_count(); ++index) {
        const PlanarBlock block = reader->read(index).value();
        const auto top = static_cast<std::size_t>(block.first_row - job.part().data_window.min_y) * width;
        block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> views) {
            for (std::size_t band = 0; band < views.size(); ++band)
                for (std::size_t i = 0; i < count; ++i)
                    out[band * height * width + top + first + i] = sample_at(views[band], i);
        });
    }
    return out;
}

TEST(DialectFile, MeansWhatTheLayoutsFileMeans) {
    const TestFolder folder;
    for (const Twin& twin : twins()) {
        const std::string path = folder.path("dialect.exr"), same = folder.path("layout.exr");
        test::write_exr(path, {part_of(twin.names, Imf::HALF, 1, twin.attributes)});
        test::write_exr(same, {part_of(twin.meaning, Imf::FLOAT, twin.scale, twin.said)});
        const std::string request = twin.meaning[0].starts_with("T.") ? "to=xyz&illuminant=FL11" : "to=xyz";
        const auto load = files::text_loader({});
        const auto dialect = open_collapse(path, request_of(request + twin.words), load);
        const auto layout = open_collapse(same, request_of(request), load);
        ASSERT_TRUE(dialect) << twin.what << ": " << dialect.error().text();
        ASSERT_TRUE(layout) << twin.what << ": " << layout.error().text();
        EXPECT_EQ(dialect->plan.wavelengths_nm(), layout->plan.wavelengths_nm()) << twin.what;
        EXPECT_EQ(dialect->plan.basis.basis, layout->plan.basis.basis) << twin.what;
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t band = 0; band < kBands; ++band)
                ASSERT_EQ(dialect->plan.weights.at(row, band), layout->plan.weights.at(row, band))
                    << twin.what;
        const auto found = samples_of(*dialect), expected = samples_of(*layout);
        ASSERT_EQ(found.size(), expected.size());
        EXPECT_TRUE(found == expected) << twin.what;
        EXPECT_EQ(dialect->part().layout.channel_names.size(), std::size_t{kBands});
    }
}

TEST(DialectFile, ScaledBandsKeepWhatIsBesideThem) {
    const TestFolder folder;
    TestPart part = part_of({"wavelength400", "wavelength410", "A", "id"}, Imf::HALF, 1, {});
    part.channels[3].type = Imf::UINT;
    test::write_exr(folder.path("a.exr"), {part});
    const auto file = open_image(folder.path("a.exr")).value();
    const Part& read = file->parts().at(0);
    const auto source = file->make_block_source(0, {0U, 1U, 2U, 3U, std::nullopt}, Grain::Block).value();
    const auto reader = source->start_reader().value();
    const PlanarBlock block = reader->read(0).value();
    for (std::size_t c = 0; c < 4; ++c) {
        const bool band = read.channels[c].name.starts_with("wavelength");
        EXPECT_EQ(block.planes[c].type, read.channels[c].delivered());
        EXPECT_EQ(read.channels[c].delivered(), band ? SampleType::Float : read.channels[c].type);
    }
    const auto bytes = test::read_with_openexr(folder.path("a.exr"), 0, "wavelength400");
    Imath::half stored;
    std::memcpy(&stored, bytes.data(), sizeof stored);
    const std::size_t channel = *read.layout.find_channel("wavelength400");
    EXPECT_EQ(
        sample_at(block.planes[channel], 0),
        static_cast<double>(static_cast<float>(static_cast<double>(static_cast<float>(stored)) * 1e-9)));
}

TEST(DialectFile, OfSeveralPartsThoseThatAMapFitsTakeIt) {
    const TestFolder folder;
    TestPart beauty = part_of({"R", "G", "B"}, Imf::HALF, 1, {});
    beauty.name = "beauty";
    TestPart bands = part_of({"0", "1", "2"}, Imf::HALF, 1, {});
    bands.name = "bands";
    test::write_exr(folder.path("a.exr"), {beauty, bands});
    OpenWords words{parse_band_steps("400:100:600").value(), std::nullopt};
    const auto file = open_image(folder.path("a.exr"), words);
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_TRUE((*file)->parts()[0].layout.sets.empty());
    EXPECT_EQ((*file)->parts()[1].layout.sets.at(0).wavelengths_nm(), (std::vector<double>{400, 500, 600}));
    words.wavelengths = parse_band_steps("400:50:600").value();
    const auto refused = open_image(folder.path("a.exr"), words);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
    EXPECT_EQ(refused.error().where, folder.path("a.exr"));
}

TEST(DialectFile, AMapTakesThePlaceOfWhatTheHeaderSaysOfTheOldBands) {
    const TestFolder folder;
    test::write_exr(folder.path("a.exr"),
                    {part_of({"S0.400nm", "S0.410nm"}, Imf::HALF, 1, [](Imf::Header& h) {
                        h.insert("spectral:binEdges", text("395;405;415"));
                        h.insert("S0.400nm", text("395nm:1;405nm:1;"));
                        h.insert("S0.410nm", text("405nm:1;415nm:1;"));
                    })});
    const OpenWords words{parse_band_table("S0.400nm,600,5\nS0.410nm,620,6", "m.csv").value(), std::nullopt};
    const auto file = open_image(folder.path("a.exr"), words).value();
    const SpectralMetadata& metadata = file->parts()[0].metadata;
    EXPECT_TRUE(metadata.bin_edges_nm.empty());
    EXPECT_TRUE(metadata.sensitivities.empty());
    ASSERT_TRUE(metadata.fwhm);
    EXPECT_EQ(metadata.fwhm->values, (std::vector<double>{5, 6}));
}

}  // namespace
}  // namespace osio::image
