// Clips: their content as arrays, edits, and files of all formats.

#include "io/AudioExtensions.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "io/FileExtension.h"
#include "io/LaneKinds.h"
#include "io/formats/ExportParameters.h"
#include "io/formats/json/ClipJson.h"
#include "python/native/ClipHandle.h"
#include "python/native/Options.h"
#include "python/native/Overwriting.h"
#include "python/native/ProfileHandle.h"
#include "python/native/Support.h"

#include <pacini/analysis/EncoderParams.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/clip/edits/Lane.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/simplify/SimplifyLanes.h>

#include <nanobind/operators.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::python
{

namespace
{
/// Points as rows of time and value; transients as rows of time, amplitude and sharpness.
using Rows = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

static_assert(sizeof(Breakpoint) == 2 * sizeof(double) && sizeof(Transient) == 3 * sizeof(double));

/// A view of something in a clip, which lives as long as the view.
nb::object viewOf(const ClipHandle& handle, const void* data, std::size_t rows, std::size_t columns)
{
    auto kept = std::make_unique<std::shared_ptr<const Clip>>(handle.shared());
    nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::shared_ptr<const Clip>*>(p); });
    static_cast<void>(kept.release());
    static const double nothing = 0.0;
    const auto* values = rows > 0 ? static_cast<const double*>(data) : &nothing;
    return nb::cast(nb::ndarray<nb::numpy, const double>(values, {rows, columns}, owner));
}

nb::object viewOf(const ClipHandle& handle, const Curve& curve)
{
    return viewOf(handle, curve.data(), curve.size(), 2);
}

Curve curveOf(const Rows& rows)
{
    if (rows.shape(1) != 2)
        raise({ErrorCode::invalidArgument, "curve", "must have a time and a value in each row"});
    Curve curve(rows.shape(0));
    for (std::size_t i = 0; i < curve.size(); ++i)
        curve[i] = {rows.data()[2 * i], rows.data()[2 * i + 1]};
    return curve;
}

ClipHandle checked(Clip clip)
{
    take(validate(clip));
    return ClipHandle(std::move(clip));
}

/// low, centre, high, priority, amplitude, pitch, phase
using BandTuple = std::tuple<double, double, double, int, Rows, Rows, double>;
using NoiseTuple = std::tuple<double, double, Rows>;
using EncoderValue = std::variant<bool, double, std::string>;

/// A clip with other content; none: as it was.
ClipHandle edited(const ClipHandle& handle, std::optional<std::string> name, std::optional<double> duration,
                  std::optional<std::tuple<std::string, double, int>> source, const std::optional<Rows>& envelope,
                  const std::optional<Rows>& centroid, const std::optional<std::vector<BandTuple>>& bands,
                  const std::optional<std::vector<NoiseTuple>>& noise, const std::optional<Rows>& transients,
                  const std::optional<std::vector<std::pair<double, std::string>>>& markers)
{
    Clip clip = handle.clip();
    if (name)
        clip.name = std::move(*name);
    if (duration)
        clip.duration = *duration;
    if (source)
        clip.source = {std::get<0>(*source), std::get<1>(*source), std::get<2>(*source)};
    if (envelope)
        clip.envelope = curveOf(*envelope);
    if (centroid)
        clip.centroid = curveOf(*centroid);
    if (bands)
    {
        clip.bands.clear();
        for (const auto& [low, centre, high, priority, amplitude, pitch, phase] : *bands)
            clip.bands.push_back({low, centre, high, priority, curveOf(amplitude), curveOf(pitch), phase});
    }
    if (noise)
    {
        clip.noise.clear();
        for (const auto& [low, high, amplitude] : *noise)
            clip.noise.push_back({low, high, curveOf(amplitude)});
    }
    if (transients)
    {
        if (transients->shape(1) != 3)
            raise({ErrorCode::invalidArgument, "transients", "must have time, amplitude and sharpness in each row"});
        clip.transients.resize(transients->shape(0));
        for (std::size_t i = 0; i < clip.transients.size(); ++i)
        {
            const double* row = transients->data() + 3 * i;
            clip.transients[i] = {row[0], row[1], row[2]};
        }
    }
    if (markers)
    {
        clip.markers.clear();
        for (const auto& [time, text] : *markers)
            clip.markers.push_back({time, text});
    }
    return checked(std::move(clip));
}

/// What a lane was, and what its simplification cost: kind, band, points before and after, RMS and largest error.
using LaneReport = std::tuple<std::string, std::size_t, std::size_t, std::size_t, double, double>;

std::pair<ClipHandle, std::vector<LaneReport>> simplified(const ClipHandle& handle, const SimplifyParams& params)
{
    auto result =
        take(abandonable([clip = handle.clip(), params] { return simplifyLanes(clip, lanesOf(clip), params); }));
    std::vector<LaneReport> lanes;
    for (const SimplifiedLane& lane : result.lanes)
        lanes.emplace_back(nameOf(lane.lane.kind, laneKinds), lane.lane.index, lane.before, lane.after, lane.error.rms,
                           lane.error.max);
    return {ClipHandle(std::move(result.clip)), std::move(lanes)};
}

SimplifyParams simplifyParams(const std::string& method, std::optional<std::size_t> count,
                              std::optional<double> maxError, bool refit)
{
    constexpr std::pair<const char*, SimplifyMethod> methods[] = {
        {"visvalingam", SimplifyMethod::visvalingam}, {"douglas-peucker", SimplifyMethod::douglasPeucker},
        {"optimal", SimplifyMethod::optimal},         {"streaming", SimplifyMethod::streaming},
        {"lagrangian", SimplifyMethod::lagrangian},
    };
    // By the names that the arguments have in Python.
    if (!count && !maxError)
        raise({ErrorCode::invalidArgument, "count", "and error are both missing; give one of them"});
    if (maxError && !(*maxError >= 0.0 && std::isfinite(*maxError)))
        raise({ErrorCode::invalidArgument, "error", "must be 0 or more"});
    SimplifyParams params;
    params.count = count;
    params.maxError = maxError;
    params.refit = refit;
    for (const auto& [name, value] : methods)
        if (method == name)
        {
            params.method = value;
            return params;
        }
    raise({ErrorCode::invalidArgument, "method",
           "must be visvalingam, douglas-peucker, optimal, streaming or lagrangian"});
}

nb::object simplifyRows(const Rows& rows, const SimplifyParams& params)
{
    const Curve curve = take(
        abandonable([dense = curveOf(rows), params] { return simplify(std::span<const Breakpoint>(dense), params); }));
    std::vector<double> values;
    values.reserve(2 * curve.size());
    for (const Breakpoint& point : curve)
        values.insert(values.end(), {point.time, point.value});
    const std::size_t points = curve.size();
    return toArray(std::move(values), {points, 2});
}

/// Options of formats of other programs by their names in Python; what is missing is as usual for the format.
struct ExportOptions
{
    nb::dict options;
    const ProfileHandle* profile = nullptr;
};

const ClipFormat& formatNamed(const std::string& name)
{
    const ClipFormat* format = clipFormatNamed(name);
    if (format == nullptr || !format->isWritten())
        raise({ErrorCode::invalidArgument, "format",
               format == nullptr ? "is not a format; pacini.formats() lists them" : "is read, but not written"});
    return *format;
}

ExportParams exportParams(const ClipFormat& format, const ExportOptions& options)
{
    const auto given = givenOptions(options.options, exportParameterInfos());
    return takeNamed(exportParamsOf(
        format, given, options.profile != nullptr ? std::optional(options.profile->profile()) : std::nullopt));
}

/// Loss of a format: kind, time, duration, error, message.
using LossTuple = std::tuple<std::string, double, double, double, std::string>;

std::vector<LossTuple> lossesOf(const ExportedClip& exported)
{
    std::vector<LossTuple> losses;
    for (const FormatLoss& loss : exported.losses)
        losses.emplace_back(lossName(loss.kind), loss.time, loss.duration, loss.error, loss.message);
    return losses;
}

ExportedClip exported(const ClipHandle& handle, const std::string& format, const ExportOptions& options, int quantise)
{
    const ClipFormat& wanted = formatNamed(format);
    const ExportParams params = exportParams(wanted, options);
    if (quantise != 0)
        take(checkValue(parameterNamed(encoderParameters, "quantise"), quantise));
    auto work = [clip = handle.clip(), &wanted, params, quantise]() mutable
    {
        if (quantise > 0)
            setQuantise(clip, quantise);
        return wanted.write(clip, params);
    };
    // Over long before a Ctrl+C could count, and a twentieth of what it takes to encode and save would be the thread's.
    constexpr double shortClip = 10.0; // s
    return take(handle.clip().duration <= shortClip ? unlocked(work) : abandonable(std::move(work)));
}

/// Whether a file is, to the byte, what the clip is as a drive signal with these options. Sounds that are exported have
/// no room for a mark.
bool isDriveOf(const ClipHandle& handle, const std::filesystem::path& path, const ExportOptions& options)
{
    for (const ClipFormat& format : clipFormats())
    {
        if (!format.isSamples || format.extension != lowerExtension(path))
            continue;
        const ExportedClip drive = exported(handle, std::string(format.name), options, 0);
        if (unlocked([&] { return static_cast<bool>(mayOverwrite(path, drive, Replaceable::own)); }))
            return true;
    }
    return false;
}

/// The clip, the warnings of its reader, and the name of the format.
using ReadTuple = std::tuple<ClipHandle, std::string, std::vector<std::string>>;

ReadTuple readFile(const std::filesystem::path& path, bool strict)
{
    auto read = takeIn(path, abandonable([path, strict] { return readClip(path, strict); }));
    return {ClipHandle(std::move(read.clip)), std::string(read.format->name), std::move(read.warnings)};
}

ReadTuple readBytes(const nb::bytes& bytes, const std::string& extension, bool strict)
{
    const std::string_view text(bytes.c_str(), bytes.size());
    const ClipFormat* format = clipFormatOf(extension, text);
    if (format == nullptr || !format->isRead())
        raise({ErrorCode::invalidData, "", "is in no format of clips that is read"});
    auto read = take(unlocked([&] { return format->read(text, strict); }));
    return {ClipHandle(std::move(read.clip)), std::string(format->name), std::move(read.warnings)};
}

std::vector<std::tuple<std::string, std::string, std::string, bool, bool, std::string>> formatList()
{
    std::vector<std::tuple<std::string, std::string, std::string, bool, bool, std::string>> list;
    for (const ClipFormat& format : clipFormats())
        list.emplace_back(format.name, format.extension, format.title, format.isRead(), format.isWritten(),
                          format.keeps);
    return list;
}

TimeRange rangeOf(double from, double to)
{
    if (!(from <= to))
        raise({ErrorCode::invalidArgument, "range", "must not end before it starts"});
    return {from, to};
}
using ClipClass = nb::class_<ClipHandle>;

void bindParts(ClipClass& bound)
{
    bound
        .def(
            "__init__",
            [](ClipHandle* self, double duration)
            {
                Clip clip;
                clip.duration = duration;
                new (self) ClipHandle(checked(std::move(clip)));
            },
            "duration"_a)
        .def_prop_ro("name", [](const ClipHandle& self) { return self.clip().name; })
        .def_prop_ro("duration", [](const ClipHandle& self) { return self.clip().duration; })
        .def_prop_ro("source",
                     [](const ClipHandle& self)
                     {
                         const ClipSource& source = self.clip().source;
                         return std::tuple(source.file, source.sampleRate, source.channels);
                     })
        .def_prop_ro("encoder",
                     [](const ClipHandle& self)
                     {
                         std::vector<std::pair<std::string, EncoderValue>> record;
                         for (const EncoderParameter& parameter : self.clip().encoder)
                             record.emplace_back(
                                 parameter.name,
                                 std::visit([](const auto& v) { return EncoderValue(v); }, parameter.value));
                         return record;
                     })
        .def_prop_ro("envelope", [](const ClipHandle& self) { return viewOf(self, self.clip().envelope); })
        .def_prop_ro("centroid", [](const ClipHandle& self) { return viewOf(self, self.clip().centroid); })
        .def_prop_ro("transients",
                     [](const ClipHandle& self)
                     {
                         const auto& transients = self.clip().transients;
                         return viewOf(self, transients.data(), transients.size(), 3);
                     })
        .def_prop_ro("markers",
                     [](const ClipHandle& self)
                     {
                         std::vector<std::pair<double, std::string>> list;
                         for (const Marker& marker : self.clip().markers)
                             list.emplace_back(marker.time, marker.name);
                         return list;
                     })
        .def_prop_ro("bands",
                     [](const ClipHandle& self)
                     {
                         nb::list list;
                         for (const Band& band : self.clip().bands)
                             list.append(nb::make_tuple(band.lowFrequency, band.centreFrequency, band.highFrequency,
                                                        band.priority, viewOf(self, band.amplitude),
                                                        viewOf(self, band.pitch), band.phase));
                         return list;
                     })
        .def_prop_ro("noise",
                     [](const ClipHandle& self)
                     {
                         nb::list list;
                         for (const NoiseBand& band : self.clip().noise)
                             list.append(
                                 nb::make_tuple(band.lowFrequency, band.highFrequency, viewOf(self, band.amplitude)));
                         return list;
                     })
        .def_prop_ro("breakpoints", [](const ClipHandle& self) { return breakpointCount(self.clip()); });
}

void bindEdits(ClipClass& bound)
{
    bound
        .def("edited", &edited, "name"_a.none() = nb::none(), "duration"_a.none() = nb::none(),
             "source"_a.none() = nb::none(), "envelope"_a.none() = nb::none(), "centroid"_a.none() = nb::none(),
             "bands"_a.none() = nb::none(), "noise"_a.none() = nb::none(), "transients"_a.none() = nb::none(),
             "markers"_a.none() = nb::none())
        .def(
            "trimmed",
            [](const ClipHandle& self, double from, double to)
            { return checked(trimClip(self.clip(), rangeOf(from, to))); },
            "start"_a, "end"_a)
        .def(
            "without",
            [](const ClipHandle& self, double from, double to)
            { return checked(take(cutClip(self.clip(), rangeOf(from, to)))); },
            "start"_a, "end"_a)
        .def(
            "joined",
            [](const ClipHandle& self, const ClipHandle& other)
            { return checked(take(joinClips(self.clip(), other.clip()))); },
            "other"_a)
        .def(
            "inserted",
            [](const ClipHandle& self, double time, const ClipHandle& part)
            { return checked(take(insertClip(self.clip(), time, part.clip()))); },
            "time"_a, "part"_a)
        .def(
            "repeated",
            [](const ClipHandle& self, int passes)
            {
                if (passes < 1 || passes > 10'000)
                    raise({ErrorCode::invalidArgument, "passes", "must be 1 to 10000"});
                return checked(take(repeatClip(self.clip(), passes)));
            },
            "passes"_a)
        .def("reversed", [](const ClipHandle& self) { return checked(reverseClip(self.clip())); })
        .def(
            "transposed",
            [](const ClipHandle& self, double semitones)
            {
                if (!(semitones >= -96.0 && semitones <= 96.0))
                    raise({ErrorCode::invalidArgument, "semitones", "must be -96 to 96"});
                return checked(transpose(self.clip(), semitones));
            },
            "semitones"_a)
        .def(
            "stretched",
            [](const ClipHandle& self, double ratio)
            {
                if (!(ratio >= 0.01 && ratio <= 100.0))
                    raise({ErrorCode::invalidArgument, "ratio", "must be 0.01 to 100"});
                return checked(take(stretchClip(self.clip(), ratio)));
            },
            "ratio"_a)
        .def(
            "simplified",
            [](const ClipHandle& self, const std::string& method, std::optional<std::size_t> count,
               std::optional<double> error, bool refit)
            { return simplified(self, simplifyParams(method, count, error, refit)); },
            "method"_a, "count"_a.none(), "error"_a.none(), "refit"_a);
}

void bindFiles(ClipClass& bound)
{
    bound
        .def("to_json",
             [](const ClipHandle& self)
             {
                 const std::string text = unlocked([&] { return writeClipJson(self.clip()); });
                 return nb::bytes(text.data(), text.size());
             })
        .def_static(
            "from_json",
            [](const nb::bytes& bytes)
            {
                const std::string_view text(bytes.c_str(), bytes.size());
                return ClipHandle(take(unlocked([&] { return readClipJson(text); })));
            },
            "text"_a)
        .def(
            "written",
            [](const ClipHandle& self, const std::string& format, const ExportOptions& options, int quantise)
            {
                const ExportedClip result = exported(self, format, options, quantise);
                nb::list files;
                for (const ExportedFile& file : result.files)
                    files.append(nb::make_tuple(file.suffix, nb::bytes(file.bytes.data(), file.bytes.size())));
                return nb::make_tuple(files, lossesOf(result));
            },
            "format"_a, "options"_a, "quantise"_a)
        .def(
            "save",
            [](const ClipHandle& self, const std::filesystem::path& path, const std::string& format,
               const ExportOptions& options, int quantise, Overwrite overwrite)
            {
                const ExportedClip result = exported(self, format, options, quantise);
                std::function<bool()> isOwn;
                if (formatNamed(format).isSamples)
                    isOwn = [&]
                    {
                        return isDriveOf(self, path, options);
                    };
                Existing existing = Existing::keep;
                for (const ExportedFile& file : result.files)
                    if (mayWrite(file.suffix.empty() ? path : exportPath(path, file.suffix), FileKind::clip, overwrite,
                                 &self.clip(), isOwn) == Existing::replace)
                        existing = Existing::replace;
                auto written = takeIn(path, unlocked([&] { return writeExport(path, result, existing); }));
                return std::pair(std::move(written), lossesOf(result));
            },
            "path"_a, "format"_a, "options"_a, "quantise"_a, "overwrite"_a.none())
        .def_prop_ro("seal",
                     [](const ClipHandle& self)
                     {
                         const ClipSeal seal = sealOf(self.clip());
                         return seal == ClipSeal::whole ? "whole" : seal == ClipSeal::broken ? "broken" : "missing";
                     })
        .def(
            "__eq__", [](const ClipHandle& self, const ClipHandle& other) { return self.clip() == other.clip(); },
            nb::is_operator());
}
} // namespace

void bindClip(nb::module_& module)
{
    nb::class_<ExportOptions>(module, "ExportOptions")
        .def(
            "__init__",
            [](ExportOptions* self, nb::dict options, const ProfileHandle* profile) {
                new (self) ExportOptions{std::move(options), profile};
            },
            "options"_a, "profile"_a.none(), nb::keep_alive<1, 3>());

    ClipClass clip(module, "ClipHandle");
    bindParts(clip);
    bindEdits(clip);
    bindFiles(clip);
    module.def("export_parameters", [] { return exportDescriptionsJson().dump(); });
    module.def("read_clip", &readFile, "path"_a, "strict"_a);
    module.def("read_clip_bytes", &readBytes, "data"_a, "extension"_a, "strict"_a);
    module.def(
        "format_written_to",
        [](const std::string& extension) -> std::optional<std::string>
        {
            const ClipFormat* format = clipFormatWrittenTo(extension);
            return format == nullptr ? std::nullopt : std::optional(std::string(format->name));
        },
        "extension"_a);
    module.def("formats", &formatList);
    module.def("audio_extensions", [] { return audioExtensions(); });
    module.def(
        "simplify_rows",
        [](const Rows& rows, const std::string& method, std::optional<std::size_t> count, std::optional<double> error,
           bool refit) { return simplifyRows(rows, simplifyParams(method, count, error, refit)); },
        "rows"_a, "method"_a, "count"_a.none(), "error"_a.none(), "refit"_a);
}

} // namespace pacini::python
