// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/spectrum.h>

#include <gtest/gtest.h>

namespace osio {
namespace {

TEST(Spectrum, StraightLinesInsideZeroOutside) {
    const Spectrum s{{400, 500, 520}, {1, 3, 0}};
    EXPECT_EQ(s.linear_at(400), 1);
    EXPECT_EQ(s.linear_at(450), 2);
    EXPECT_EQ(s.linear_at(510), 1.5);
    EXPECT_EQ(s.linear_at(520), 0);
    EXPECT_EQ(s.linear_at(399.999), 0);
    EXPECT_EQ(s.linear_at(520.001), 0);
}

TEST(SpectrumText, ReadsBothWritersOfTheLayout) {
    const std::vector<double> nm{400, 500, 600}, values{0.1, 0.2, 0.3};
    for (const char* text : {"400nm:0.1;500nm:0.2;600nm:0.3;",       // reference library
                             "400nm:0.1;500nm:0.2;600nm:0.3",        // colour-science
                             " 500 nm : 0.2 ;400nm:0.1; 0.6um:.3;",  // by hand, in any order
                             "400,0nm:0,1;500,0nm:0,2;600nm:+0.3;"}) {
        const SpectrumText parsed = parse_spectrum_text(text);
        EXPECT_EQ(parsed.spectrum.wavelengths_nm, nm) << text;
        EXPECT_EQ(parsed.spectrum.values, values) << text;
        EXPECT_TRUE(parsed.rejected.empty()) << text;
    }
}

TEST(SpectrumText, KeepsNegativeValuesAndReportsWhatIsNoSample) {
    const SpectrumText parsed = parse_spectrum_text("400nm:-0.1;nm:0.5;500:1;600nm:nan;700nm:inf;800nm;");
    EXPECT_EQ(parsed.spectrum.wavelengths_nm, std::vector<double>{400});
    EXPECT_EQ(parsed.spectrum.values, std::vector<double>{-0.1});
    EXPECT_EQ(parsed.rejected.size(), 5U);
}

TEST(SpectrumCsv, ReadsTheUsualShapes) {
    for (const char* text :
         {"400,1\n500,2\n", "nm,value\n400,1\n500,2", "# a lamp\n400,1\n# half way\n500,2\n",
          "\xEF\xBB\xBFwavelength;power\r\n400;1\r\n500;2\r\n", "400\t1\n500\t2\n", "400 1\n500   2\n",
          "\n\n400, 1.0\n\n500 , 2e0\n"}) {
        const auto parsed = parse_spectrum_csv(text);
        ASSERT_TRUE(parsed) << text << parsed.error().text();
        EXPECT_EQ(parsed->wavelengths_nm, (std::vector<double>{400, 500})) << text;
        EXPECT_EQ(parsed->values, (std::vector<double>{1, 2})) << text;
    }
}

TEST(SpectrumCsv, SaysWhatIsWrongAndWhere) {
    const auto error = [](const char* text) {
        const auto parsed = parse_spectrum_csv(text);
        return parsed ? std::string("no error") : parsed.error().text();
    };
    EXPECT_EQ(error("400,1\n500,x\n"),
              "line 2: found \"500,x\", expected two numbers: wavelength in nm, value");
    EXPECT_EQ(error("nm,value\nmore,text\n"),
              "line 2: found \"more,text\", expected two numbers: wavelength in nm, value");
    EXPECT_EQ(error("400,1\n500\n"), "line 2: found \"500\", expected two numbers: wavelength in nm, value");
    EXPECT_EQ(error("500,1\n400,2\n"),
              "line 2: 400 nm follows 500 nm; wavelengths must increase from line to line");
    EXPECT_EQ(error("400,1\n400,2\n"),
              "line 2: 400 nm follows 400 nm; wavelengths must increase from line to line");
    EXPECT_EQ(error("-400,1\n"), "line 1: a wavelength of -400 nm is not positive");
    EXPECT_EQ(error("400,1,2\n"), "line 1: found \"400,1,2\", expected two numbers: wavelength in nm, value");
    EXPECT_EQ(error("400,nan\n"), "line 1: found \"400,nan\", expected two numbers: wavelength in nm, value");
    EXPECT_EQ(error("0.4,1\n0.7,2\n"),
              "the wavelengths end at 0.7: these look like micrometres; nanometres are expected");
    EXPECT_EQ(error(""), "no line with a wavelength in nm and a value");
    EXPECT_EQ(error("nm,value\n"), "no line with a wavelength in nm and a value");
}

TEST(SpectrumText, IsWrittenSoThatEveryReaderTakesAll) {
    EXPECT_EQ(format_spectrum_text({{400, 450.5, 1000}, {0.1, -2, 1e-9}}),
              "400nm:0.1;450.5nm:-2;1000nm:1e-09;1000nm:1e-09");
    EXPECT_EQ(format_spectrum_text({}), "");
    for (const char* text : {"400nm:0.1", "0,5um:1;400 nm : 2 ;", "600nm:3;500nm:0.1;500nm:9;"}) {
        const Spectrum read = parse_spectrum_text(text).spectrum;
        const SpectrumText again = parse_spectrum_text(format_spectrum_text(read));
        EXPECT_TRUE(again.rejected.empty());
        EXPECT_EQ(again.spectrum.wavelengths_nm, read.wavelengths_nm);
        EXPECT_EQ(again.spectrum.values, read.values);
    }
}

}  // namespace
}  // namespace osio
