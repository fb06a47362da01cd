// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/exit_code.h>

#include <osio/base/result.h>
#include <osio/collapse/baked_matrix.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

/// One function for each subcommand, in a file of its own. Each returns the process's exit code;
/// results go to stdout, everything else to stderr.
namespace osio::tool {

/// Options as they were given: the request's own words and their values.
using RequestWords = std::vector<std::pair<std::string, std::string>>;

struct InfoOptions {
    std::string input;
    RequestWords request;  ///< wavelengths and quantity
    bool json = false;
};

struct AuditOptions {
    std::vector<std::string> inputs;
    RequestWords request;  ///< wavelengths and quantity
    bool json = false;
};

struct PlanOptions {
    std::string input;
    RequestWords request;
    bool explain = false;
    std::optional<std::string> svg;  ///< a picture of the plan
    unsigned threads = 0;            ///< of explain
    bool json = false;
};

struct CollapseOptions {
    std::string input;
    std::string output;
    RequestWords request;
    std::string depth;        ///< half, float, uint8, uint16; empty: what suits the output
    std::string compression;  ///< of EXR output; empty: zip
    std::string certificate;  ///< .json; empty: none
    unsigned threads = 0;
    bool raw = false;            ///< linear values into integers are wanted
    bool allow_partial = false;  ///< keep what is sound of a damaged input
    bool fsync = false;          ///< done only when the storage has every byte
    std::string frames;          ///< "1-10x2,15"; empty: the names are those of files
    bool quiet = false;
    bool json = false;
};

struct ConvertOptions {
    std::vector<std::string> files;  ///< the input, or several to be joined, then the output
    RequestWords request;            ///< wavelengths and quantity
    std::string part;
    std::string set;
    std::string bands;        ///< "400-700nm"; empty: all
    std::string resample;     ///< "400:10:700"; empty: the bands' own wavelengths
    std::string basis;        ///< of resample; empty: auto
    std::string extrapolate;  ///< of resample: hold, zero; empty: hold
    std::string preview;      ///< a light, or none; empty: R, G, B as they are
    std::string depth;        ///< of EXR output: half, float; empty: as they are
    std::string tile;         ///< of EXR output: "64x64"; empty: scanlines
    std::string split;        ///< bands, sets; empty: one file
    std::string frames;       ///< "1-10x2,15"; empty: the names are those of files
    bool half = false;        ///< the same as depth half
    bool assemble = false;    ///< several inputs
    bool multi_part = false;
    bool fsync = false;
    std::string interleave;   ///< of ENVI output: bsq, bil, bip; empty: bsq
    std::string compression;  ///< of EXR output; empty: zip
    unsigned threads = 0;
    bool quiet = false;
    bool json = false;
};

struct VerifyOptions {
    std::vector<std::string> inputs;
    unsigned threads = 0;
    bool json = false;
};

struct DifferenceOptions {
    std::string a;
    std::string b;
    RequestWords request;
    std::string map;                  ///< .exr of differences; empty: none
    std::optional<double> fail;       ///< CIEDE2000 beyond which a pixel fails
    double fail_percent = 0;          ///< of pixels that may fail
    std::optional<double> hard_fail;  ///< beyond which one pixel is enough
    std::optional<double> warn;
    unsigned threads = 0;
    bool quiet = false;
    bool json = false;
};

struct PhotometryOptions {
    std::string input;   ///< empty: a light
    std::string output;  ///< .exr of luminance; empty: none
    RequestWords request;
    unsigned threads = 0;
    bool quiet = false;
    bool json = false;
};

struct BakeOptions {
    std::string what;  ///< adaptation, primaries, relight, observer, camera
    std::string output;
    MatrixRequest request;
    std::string adapt;   ///< empty: the request's default
    std::string domain;  ///< LOW,HIGH of a .cube; empty: 0,1
    int size = 2;        ///< points along an edge of a .cube
    bool json = false;
};

struct WeightsOptions {
    std::string input;
    RequestWords request;
    bool oiiotool = false;  ///< a command instead of a table
    std::string output;     ///< of that command; empty: out.exr
};

struct SpectrumOptions {
    std::string input;
    RequestWords request;            ///< wavelengths and quantity
    std::vector<std::string> place;  ///< X and Y, or WxH+X+Y; empty: all pixels
    std::string part;
    std::string set;
    std::string output;  ///< .csv or .svg; empty: CSV on stdout
    bool range = false;  ///< CSV has minimum and maximum too
};

struct TradeOptions {
    std::string input;
    RequestWords request;
    int runs = 3;
    std::string html;  ///< a page to be written; empty: none
    unsigned threads = 0;
    bool quiet = false;
    bool json = false;
    bool csv = false;
};

struct ReduceOptions {
    std::string input;
    std::string output;
    RequestWords request;
    double tolerance = 0;  ///< CIEDE2000
    std::string lights;    ///< between commas; empty: none, for radiance
    std::string observers = "cie1931";
    std::string compression;  ///< empty: the fastest to read
    bool scene_basis = false;
    bool fsync = false;
    unsigned threads = 0;
    bool quiet = false;
    bool json = false;
};

struct ListOptions {
    std::string what;    ///< illuminants, observers, spaces, bases
    std::string config;  ///< of spaces: OCIO config to list too; empty: the environment's
    bool json = false;   ///< of spaces
};

[[nodiscard]] Result<ExitCode> run_info(const InfoOptions& options);
[[nodiscard]] Result<ExitCode> run_audit(const AuditOptions& options);
[[nodiscard]] Result<ExitCode> run_plan(const PlanOptions& options);
[[nodiscard]] Result<ExitCode> run_collapse(const CollapseOptions& options);
[[nodiscard]] Result<ExitCode> run_convert(const ConvertOptions& options);
[[nodiscard]] Result<ExitCode> run_verify(const VerifyOptions& options);
[[nodiscard]] Result<ExitCode> run_difference(const DifferenceOptions& options);
[[nodiscard]] Result<ExitCode> run_photometry(const PhotometryOptions& options);
[[nodiscard]] Result<ExitCode> run_bake(const BakeOptions& options);
[[nodiscard]] Result<ExitCode> run_weights(const WeightsOptions& options);
[[nodiscard]] Result<ExitCode> run_spectrum(const SpectrumOptions& options);
[[nodiscard]] Result<ExitCode> run_trade(const TradeOptions& options);
[[nodiscard]] Result<ExitCode> run_reduce(const ReduceOptions& options);
[[nodiscard]] Result<ExitCode> run_list(const ListOptions& options);
[[nodiscard]] Result<ExitCode> run_doctor();

}  // namespace osio::tool
