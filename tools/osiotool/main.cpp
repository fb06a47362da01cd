// SPDX-License-Identifier: Apache-2.0
//
// The command line: words to options, options to a command, its result to an exit code.
#include <tools/osiotool/commands.h>
#include <tools/osiotool/request_options.h>

#include <formats/exr/exr_file.h>

#include <osio/base/text.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>

namespace osio::tool {

namespace {

/// A command and what runs it.
using Run = std::function<Result<ExitCode>()>;

class CommandLine {
  public:
    CommandLine() : m_app("Multispectral EXR: information, and collapse to colour.", "osiotool") {
        m_app.set_version_flag("--version",
                               fmt::format("osiotool {} (OpenEXR {})", OSIO_VERSION, exr::library_version()));
        m_app.require_subcommand(1);
        m_app.footer("Exit codes: 0 done, 1 the request does not fit the file, 2 usage or unknown "
                     "name, 3 not certified as max-delta-e asks, 4 input damaged or not spectral, 5 the "
                     "system refused, 130 interrupted.");
        add_info();
        add_audit();
        add_collapse();
        add_plan();
        add_convert();
        add_verify();
        add_difference();
        add_photometry();
        add_bake();
        add_weights();
        add_spectrum();
        add_trade();
        add_reduce();
        add_list();
        add("doctor", "tell whether OpenImageIO sees our plugins, and if not, why",
            [] { return run_doctor(); });
    }

    int main(int argc, char** argv) {
        if (argc == 1) {
            fmt::print("{}", m_app.help());
            return kUsage;
        }
        try {
            m_app.parse(argc, argv);
        } catch (const CLI::Success& success) {
            return m_app.exit(success);  // --help, --version
        } catch (const CLI::ParseError& error) {
            return complain(error.what() + hint(argc, argv));
        }
        const auto result = m_run();
        if (!result)
            return complain(result.error().text(), exit_code(result.error().code));
        return *result;
    }

  private:
    static int complain(const std::string& text, int code = kUsage) {
        fmt::print(stderr, "osiotool: {}\n", text);
        return code;
    }

    CLI::App* add(const std::string& name, const std::string& help, Run run) {
        CLI::App* const command = m_app.add_subcommand(name, help);
        command->callback([this, run = std::move(run)] { m_run = run; });
        return command;
    }

    void add_info() {
        CLI::App* const command = add("info", "what a file holds: parts, bands, units, warnings",
                                      [this] { return run_info(m_info); });
        command->add_option("file", m_info.input, "OpenEXR, ENVI or TIFF file, or list of band files")
            ->required();
        add_open_options(*command, m_info.request);
        command->add_flag("--json", m_info.json, "as JSON");
    }

    void add_audit() {
        CLI::App* const command =
            add("audit", "who wrote a file, what is assumed of it, its writer's quirks, what is wrong",
                [this] { return run_audit(m_audit); });
        command->add_option("file", m_audit.inputs, "OpenEXR or ENVI files")->required();
        add_open_options(*command, m_audit.request);
        command->add_flag("--json", m_audit.json, "as JSON");
    }

    void add_collapse() {
        CLI::App* const command =
            add("collapse", "bands to a colour image", [this] { return run_collapse(m_collapse); });
        command->add_option("input", m_collapse.input, "spectral image")->required();
        command->add_option("output", m_collapse.output, "image; .exr, .png, .tif, ...")->required();
        add_request_options(*command, m_collapse.request);
        command->add_option("-d", m_collapse.depth, "type of the output's samples")
            ->type_name("half|float|uint8|uint16")
            ->group("Output");
        command->add_option("--compression", m_collapse.compression, "of .exr output; default zip")
            ->type_name("C")
            ->group("Output");
        command
            ->add_option("--certificate", m_collapse.certificate,
                         "writes what is proved of the result's error, and what is not")
            ->type_name("FILE.json")
            ->group("Output");
        command->add_flag("--raw", m_collapse.raw, "allow linear values in integers")->group("Output");
        command
            ->add_flag("--allow-partial", m_collapse.allow_partial,
                       "damaged rows of the input become black rows; exit code 4 all the same")
            ->group("Output");
        command->add_flag("--fsync", m_collapse.fsync, "done only when the storage has every byte")
            ->group("Output");
        command->add_option("--frames", m_collapse.frames, "once for each; names need %04d or ####")
            ->type_name("1-10x2,15")
            ->group("Output");
        command->add_option("--threads", m_collapse.threads, "default: one a processor")
            ->type_name("N")
            ->group("Output");
        command->add_flag("--quiet", m_collapse.quiet, "no summary, no progress");
        command->add_flag("--json", m_collapse.json, "a report on stdout as JSON");
    }

    void add_plan() {
        CLI::App* const command = add("plan", "what a collapse would do: recipe, weights, provenance",
                                      [this] { return run_plan(m_plan); });
        command->add_option("input", m_plan.input, "spectral image")->required();
        add_request_options(*command, m_plan.request, {"max-delta-e", "white-luminance"});
        command->add_flag("--explain", m_plan.explain,
                          "what it would do and do without, and how long each step would take");
        command->add_option("--svg", m_plan.svg, "draw the light, bands, weights and budget")
            ->type_name("OUT.svg");
        command->add_option("--threads", m_plan.threads, "of --explain; default: one a processor")
            ->type_name("N");
        command->add_flag("--json", m_plan.json, "as JSON");
    }

    void add_convert() {
        CLI::App* const command = add("convert", "bands from one format to another, as they are",
                                      [this] { return run_convert(m_convert); });
        command
            ->add_option(
                "files", m_convert.files,
                "input, then output: .exr, .spexr, .hdr for ENVI, or .tif; several inputs with --assemble")
            ->required()
            ->expected(2, -1)
            ->type_name("IN... OUT");
        const auto word = [command](const std::string& name, std::string& value, const std::string& type,
                                    const std::string& help) {
            command->add_option(name, value, help)->type_name(type);
        };
        add_open_options(*command, m_convert.request);
        word("--part", m_convert.part, "PART", "number from 0, or name");
        word("--set", m_convert.set, "SET", "where a part holds several");
        command->add_flag("--assemble", m_convert.assemble, "channels of several inputs in one output");
        word("--resample", m_convert.resample, "400:10:700", "bands at other wavelengths, nm");
        word("--basis", m_convert.basis, "NAME", "of --resample: what lies between bands; default auto");
        word("--extrapolate", m_convert.extrapolate, "hold|zero",
             "of --resample: beyond the bands; default hold");
        word("--bands", m_convert.bands, "400-700nm", "bands outside are left out");
        word("--split", m_convert.split, "bands|sets", "a file of each; {nm}, {set} in the output's name");
        word("--frames", m_convert.frames, "1-10x2,15", "once for each; names need %04d or ####");
        word("-d", m_convert.depth, "half|float", "of .exr; default: as they are");
        command->add_flag("--half", m_convert.half, "the same as -d half");
        word("--compression", m_convert.compression, "C", "of .exr; default zip; of .tif none or zip");
        word("--tile", m_convert.tile, "WxH", "of .exr; default: scanlines");
        word("--preview", m_convert.preview, "LIGHT|none", "of .exr: R, G, B made of the bands");
        command->add_flag("--multi-part", m_convert.multi_part,
                          "of .exr: R, G, B in a part before the bands");
        word("--interleave", m_convert.interleave, "bsq|bil|bip", "of .hdr; default bsq");
        command->add_flag("--fsync", m_convert.fsync, "done only when the storage has every byte");
        command->add_option("--threads", m_convert.threads, "default: one a processor")->type_name("N");
        command->add_flag("--quiet", m_convert.quiet, "no summary, no progress");
        command->add_flag("--json", m_convert.json, "a report on stdout as JSON");
    }

    void add_verify() {
        CLI::App* const command = add("verify", "decode everything, say what is sound and what is not",
                                      [this] { return run_verify(m_verify); });
        command->add_option("file", m_verify.inputs, "OpenEXR files")->required();
        command->add_option("--threads", m_verify.threads, "default: one a processor")->type_name("N");
        command->add_flag("--json", m_verify.json, "as JSON");
    }

    void add_difference() {
        CLI::App* const command = add("difference", "colour difference CIEDE2000 between two images",
                                      [this] { return run_difference(m_difference); });
        command->add_option("a", m_difference.a, "spectral image, or RGB or XYZ OpenEXR file")->required();
        command->add_option("b", m_difference.b, "the same")->required();
        add_request_options(
            *command, m_difference.request,
            {"to", "config", "names", "adapt", "display", "scale", "max-delta-e", "white-luminance"});
        command->add_option("--map", m_difference.map, "writes the difference of every pixel")
            ->type_name("FILE.exr");
        command->add_option("--fail", m_difference.fail, "a pixel beyond this fails: exit code 1")
            ->type_name("DE");
        command->add_option("--failpercent", m_difference.fail_percent, "so many may; default 0")
            ->type_name("PERCENT");
        command->add_option("--hardfail", m_difference.hard_fail, "no pixel may be beyond this")
            ->type_name("DE");
        command->add_option("--warn", m_difference.warn, "a pixel beyond this is worth a word")
            ->type_name("DE");
        command->add_option("--threads", m_difference.threads, "default: one a processor")->type_name("N");
        command->add_flag("--quiet", m_difference.quiet, "no warnings, no progress");
        command->add_flag("--json", m_difference.json, "as JSON");
    }

    void add_photometry() {
        CLI::App* const command = add("photometry", "luminance of a radiance image, or efficacy of a light",
                                      [this] { return run_photometry(m_photometry); });
        command->add_option("input", m_photometry.input, "spectral image; none: --illuminant");
        command->add_option("output", m_photometry.output, "luminance image, .exr");
        add_request_options(*command, m_photometry.request,
                            {"to", "config", "names", "adapt", "observer", "white", "display", "scale",
                             "filter-normalise", "max-delta-e", "white-luminance"});
        command->add_option("--threads", m_photometry.threads, "default: one a processor")->type_name("N");
        command->add_flag("--quiet", m_photometry.quiet, "no warnings, no progress");
        command->add_flag("--json", m_photometry.json, "as JSON");
    }

    void add_bake() {
        CLI::App* const command =
            add("bake", "a conversion that a 3x3 matrix can say, as .clf, .spimtx or .cube",
                [this] { return run_bake(m_bake); });
        MatrixRequest& request = m_bake.request;
        command->add_option("what", m_bake.what, "adaptation, primaries, relight, observer or camera")
            ->required();
        command->add_option("output", m_bake.output, "OUT.clf, OUT.spimtx or OUT.cube")->required();
        const auto word = [command](const std::string& name, std::string& value, const std::string& type,
                                    const std::string& help) {
            return command->add_option("--" + name, value, help)->type_name(type);
        };
        word("from", request.from, "NAME|FILE.csv", "light, space, observer or a camera's table")->required();
        word("to", request.to, "NAME|FILE.csv", "light, space or observer; of a camera a space")->required();
        word("illuminant", request.illuminant, "NAME|FILE.csv",
             "of observer and camera: the light; default D65");
        word("observer", request.observer, "NAME", "of lights and cameras; default cie1931");
        word("reflectances", request.reflectances, "FILE.csv",
             "nm and spectra to fit to; default colorchecker");
        command->add_flag("--keep-white", request.keep_white,
                          "of fits: the perfect diffuser comes out exactly");
        word("adapt", m_bake.adapt, "NAME", "chromatic adaptation; default bradford");
        word("domain", m_bake.domain, "LOW,HIGH", "of .cube, which clips beyond; default 0,1");
        command->add_option("--size", m_bake.size, "of .cube: points along an edge; default 2")
            ->type_name("N");
        command->add_flag("--json", m_bake.json, "as JSON");
    }

    void add_weights() {
        CLI::App* const command =
            add("weights", "a collapse as a table, or as a command that needs no plugin",
                [this] { return run_weights(m_weights); });
        command->add_option("input", m_weights.input, "spectral OpenEXR file")->required();
        add_request_options(*command, m_weights.request, {"names", "max-delta-e", "white-luminance"});
        command->add_flag("--oiiotool", m_weights.oiiotool, "the command of a stock oiiotool");
        command->add_option("-o", m_weights.output, "output of that command; default out.exr")
            ->type_name("OUT");
    }

    void add_spectrum() {
        CLI::App* const command = add("spectrum", "the spectrum of a pixel or region, as a table or a plot",
                                      [this] { return run_spectrum(m_spectrum); });
        command->add_option("input", m_spectrum.input, "spectral image")->required();
        command->add_option("place", m_spectrum.place, "X Y, or WxH+X+Y; none: all pixels")
            ->expected(0, 2)
            ->type_name("X Y|REGION");
        add_open_options(*command, m_spectrum.request);
        command->add_option("--part", m_spectrum.part, "part of a multi-part file")->type_name("N|NAME");
        command->add_option("--set", m_spectrum.set, "which bands, where there are several sets")
            ->type_name("[ROOT.]S0..S3|T");
        command->add_option("-o", m_spectrum.output, "OUT.csv or OUT.svg; default: a table on stdout")
            ->type_name("OUT");
        command->add_flag("--range", m_spectrum.range, "of a table: minimum and maximum of the region too");
    }

    void add_trade() {
        CLI::App* const command = add("trade", "what accuracy costs on this image: every choice, measured",
                                      [this] { return run_trade(m_trade); });
        command->add_option("input", m_trade.input, "spectral image")->required();
        add_request_options(*command, m_trade.request, {"max-delta-e", "names"});
        command->add_option("--runs", m_trade.runs, "of each choice; default 3")->type_name("N");
        command->add_option("--html", m_trade.html, "a page with plot, pictures, maps and spectra")
            ->type_name("OUT.html");
        command->add_option("--threads", m_trade.threads, "default: one a processor")->type_name("N");
        command->add_flag("--quiet", m_trade.quiet, "no warnings, no progress");
        command->add_flag("--json", m_trade.json, "as JSON");
        command->add_flag("--csv", m_trade.csv, "as comma-separated values");
    }

    void add_reduce() {
        CLI::App* const command =
            add("reduce", "the smallest spectral file that this scene requires under some lights",
                [this] { return run_reduce(m_reduce); });
        command->add_option("input", m_reduce.input, "spectral image")->required();
        command->add_option("output", m_reduce.output, "OUT.exr or OUT.spexr")->required();
        command->add_option("--max-delta-e", m_reduce.tolerance, "CIEDE2000 that no pixel exceeds")
            ->required()
            ->type_name("DE");
        command->add_option("--lights", m_reduce.lights, "of reflectances: D65,A,FL11 or tables")
            ->type_name("NAME,...");
        command->add_option("--observers", m_reduce.observers, "default cie1931")->type_name("NAME,...");
        add_words(*command, m_reduce.request, [](const std::string& key) {
            return holds({"wavelengths", "quantity", "part", "set", "basis", "white-luminance"}, key);
        });
        command
            ->add_option("--compression", m_reduce.compression,
                         "one without loss; default: the fastest to read")
            ->type_name("C");
        command->add_flag("--per-scene-basis", m_reduce.scene_basis,
                          "coefficients of the scene's own curves, which only this project reads");
        command->add_flag("--fsync", m_reduce.fsync, "done only when the storage has every byte");
        command->add_option("--threads", m_reduce.threads, "default: one a processor")->type_name("N");
        command->add_flag("--quiet", m_reduce.quiet, "no summary, no progress");
        command->add_flag("--json", m_reduce.json, "a report on stdout as JSON");
    }

    void add_list() {
        CLI::App* const command = add("list", "names that options take", [this] { return run_list(m_list); });
        command->add_option("what", m_list.what, "illuminants, observers, spaces or bases")->required();
        command->add_option("--config", m_list.config, "of spaces: OCIO config to list too; default: OCIO's")
            ->type_name("FILE.ocio");
        command->add_flag("--json", m_list.json, "of spaces, as JSON");
    }

    /// The nearest subcommand or option to the first word that nobody knows.
    [[nodiscard]] std::string hint(int argc, char** argv) const {
        std::vector<std::string> commands;
        const CLI::App* chosen = nullptr;
        for (const CLI::App* command : m_app.get_subcommands({})) {
            commands.push_back(command->get_name());
            if (argc > 1 && command->get_name() == argv[1])
                chosen = command;
        }
        if (chosen == nullptr)
            return suggestion(argv[1], commands);
        std::vector<std::string> options;
        for (const CLI::Option* option : chosen->get_options())
            options.push_back(option->get_name());
        for (int i = 2; i < argc; ++i) {
            const std::string word(argv[i]);
            const std::string name = word.substr(0, word.find('='));
            if (word.starts_with("-") && std::find(options.begin(), options.end(), name) == options.end())
                if (const auto nearest = nearest_name(name, options))
                    return "; did you mean \"" + *nearest + "\"?";
        }
        return "; see osiotool " + chosen->get_name() + " --help";
    }

    CLI::App m_app;
    Run m_run;
    InfoOptions m_info;
    AuditOptions m_audit;
    CollapseOptions m_collapse;
    PlanOptions m_plan;
    ConvertOptions m_convert;
    VerifyOptions m_verify;
    DifferenceOptions m_difference;
    PhotometryOptions m_photometry;
    BakeOptions m_bake;
    WeightsOptions m_weights;
    SpectrumOptions m_spectrum;
    TradeOptions m_trade;
    ReduceOptions m_reduce;
    ListOptions m_list;
};

}  // namespace

}  // namespace osio::tool

int main(int argc, char** argv) {
    try {
        return osio::tool::CommandLine().main(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "osiotool: {}\n", error.what());
        return osio::tool::kSystem;
    }
}
