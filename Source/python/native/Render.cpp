// Scenes, and the way from clips and scenes to drive signals or what is felt of them.

#include "io/SceneCheck.h"
#include "io/SceneFile.h"
#include "io/SceneJson.h"
#include "python/native/ClipHandle.h"
#include "python/native/Options.h"
#include "python/native/Overwriting.h"
#include "python/native/ProfileHandle.h"
#include "python/native/SceneHandle.h"
#include "python/native/Support.h"

#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/RenderScene.h>

#include <nanobind/operators.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
[[noreturn]] void wrong(std::string where, std::string message)
{
    raise({ErrorCode::invalidArgument, std::move(where), std::move(message)});
}

/// The one of `choices` that has this name; none for none.
template <typename T, std::size_t n>
std::optional<T> chosen(const std::optional<std::string>& name, const char* where,
                        const std::pair<const char*, T> (&choices)[n])
{
    if (!name)
        return std::nullopt;
    std::string names;
    for (const auto& [text, value] : choices)
    {
        if (*name == text)
            return value;
        names += (names.empty() ? "" : ", ") + std::string(text);
    }
    wrong(where, "must be one of " + names);
}

/// Sets a parameter that `table` describes. Raises pacini.Error.
template <typename Table, typename Params>
void setAllowed(const Table& table, Params& params, std::string_view name, double value)
{
    const auto& parameter = parameterNamed(table, name);
    takeNamed(checkValue(parameter, value));
    parameter.set(params, value);
}

/// Rendering options.
struct RenderOptions : RenderParams
{
    std::optional<Profile> profile;

    void put(std::string_view name, double value) { setAllowed(renderParameters, *this, name, value); }

    void set(double rate, double tolerance, bool leaveOut, bool adapt, const std::optional<std::string>& mapping,
             double maxBoost, double strength, bool protectIt)
    {
        put("sampleRate", rate);
        put("tolerance", tolerance);
        compile.leaveOut = leaveOut;
        compile.adapt = adapt;
        compile.adaptation.mapping = chosen<FrequencyMapping>(mapping, "mapping",
                                                              {{"clamp", FrequencyMapping::clamp},
                                                               {"rescale", FrequencyMapping::rescale},
                                                               {"fold", FrequencyMapping::fold}});
        put("maxBoost", maxBoost);
        put("strength", strength);
        protect = protectIt;
    }
    void adjust(double gain, double transpose, double stretch, double delay, double variation,
                const std::string& variationPer, std::uint64_t seed)
    {
        const auto scope =
            chosen<VariationScope>(variationPer, "variation_per",
                                   {{"breakpoint", VariationScope::breakpoint}, {"band", VariationScope::band}});
        put("gain", gain);
        put("transpose", transpose);
        put("stretch", stretch);
        put("delay", delay);
        put("variation", variation);
        adjustment.variation.scope = *scope;
        adjustment.variation.seed = seed;
    }
    void decode(const std::optional<std::string>& carriers, std::optional<bool> followEnvelope,
                const std::optional<std::string>& pulse, std::optional<double> pulseFrequency, double pulseCycles)
    {
        DecoderChoice& decoder = compile.decoder;
        decoder.carriers = chosen<CarrierMode>(
            carriers, "carriers",
            {{"fixed", CarrierMode::fixed}, {"pitch", CarrierMode::pitch}, {"centroid", CarrierMode::centroid}});
        decoder.followEnvelope = followEnvelope;
        decoder.pulseShape = chosen<PulseShape>(
            pulse, "pulse",
            {{"adaptive", PulseShape::adaptive}, {"square", PulseShape::square}, {"sine", PulseShape::sine}});
        if (pulseFrequency)
            put("pulseFrequency", *pulseFrequency);
        put("pulseCycles", pulseCycles);
    }
    void part(double start, std::optional<double> end)
    {
        if (!(start >= 0.0 && start <= limits::duration))
            wrong("start", "must be 0 s to 24 h");
        from = start;
        if (end && !(*end > start))
            wrong("end", "must be after start");
        to = end;
    }
    void feel(unsigned wearer, double fullScale)
    {
        setAllowed(feltParameters, felt.emplace(), "wearer", wearer);
        setAllowed(feltParameters, *felt, "fullScale", fullScale);
    }
};

/// Without the lock.
Result<RenderedScene> rendered(Scene scene, const RenderOptions& options, Watch& watch)
{
    return renderScene(std::move(scene), options.profile ? &*options.profile : nullptr, options,
                       [&watch](double share)
                       {
                           watch(share);
                           return Result<void>();
                       });
}

nb::object handedOut(RenderedScene&& made)
{
    const RenderReport& report = made.report;
    nb::list adaptations, leftOut;
    for (const Adaptation& adaptation : report.adaptations)
        adaptations.append(nb::make_tuple(adaptation.where, adaptation.what));
    for (const LeftOut& item : report.leftOut)
        leftOut.append(nb::make_tuple(item.where, item.reason, item.error));
    return nb::make_tuple(toArray(std::move(made.samples), {report.actuators, static_cast<std::size_t>(report.frames)}),
                          report.reduction, report.predictedError, adaptations, leftOut);
}

/// "0" to the first of `clips`, and so on: a text of a scene names them so.
ClipLoader loaderOf(const std::vector<ClipHandle>& clips)
{
    return [&clips](const std::string& file) -> Result<Clip>
    {
        std::size_t index = clips.size();
        try
        {
            index = std::stoul(file);
        }
        catch (const std::exception&)
        {
        }
        if (index >= clips.size())
            return Error{ErrorCode::invalidData, "", "is none of the clips"};
        return clips[index].clip();
    };
}
} // namespace

void bindRender(nb::module_& module)
{
    nb::class_<SceneHandle>(module, "SceneHandle")
        .def_static(
            "of_clip", [](const ClipHandle& clip) { return SceneHandle(sceneOf(clip.clip())); }, "clip"_a)
        .def_static(
            "from_json",
            [](const std::string& text, const std::vector<ClipHandle>& clips)
            {
                ReadWarnings strict(true);
                return SceneHandle(take(unlocked([&] { return readSceneJson(text, loaderOf(clips), &strict); })));
            },
            "text"_a, "clips"_a)
        .def_static(
            "read",
            [](const std::filesystem::path& path, const std::filesystem::path& clipFolder, bool strict)
            {
                ReadWarnings warnings(strict);
                auto scene = unlocked([&] { return readScene(path, clipFolder, &warnings); });
                if (!scene)
                {
                    Error error = scene.error();
                    error.where = path.string() + (error.where.empty() ? "" : ": ") + error.where;
                    raise(error);
                }
                return std::pair(SceneHandle(std::move(*scene)), warnings.texts());
            },
            "path"_a, "clip_folder"_a, "strict"_a)
        .def("to_json", [](const SceneHandle& self) { return unlocked([&] { return writeSceneJson(self.scene()); }); })
        .def(
            "save",
            [](const SceneHandle& self, const std::filesystem::path& path, Overwrite overwrite)
            {
                const Existing existing = mayWrite(path, FileKind::scene, overwrite);
                return take(unlocked(
                    [&]() -> Result<std::size_t>
                    {
                        if (auto valid = validate(self.scene()); !valid)
                            return valid.error();
                        return writeFileAtomically(path, writeSceneJson(self.scene()), existing);
                    }));
            },
            "path"_a, "overwrite"_a.none())
        .def_prop_ro("name", [](const SceneHandle& self) { return self.scene().name; })
        .def_prop_ro("duration", [](const SceneHandle& self) { return self.scene().duration; })
        .def_prop_ro("actuators", [](const SceneHandle& self) { return self.scene().actuators; })
        .def_prop_ro("clips",
                     [](const SceneHandle& self)
                     {
                         std::vector<ClipHandle> clips;
                         for (const Clip& clip : self.scene().clips)
                             clips.emplace_back(clip);
                         return clips;
                     })
        .def("lint",
             [](const SceneHandle& self)
             {
                 std::vector<std::pair<std::string, std::string>> list;
                 for (SceneFinding& finding : unlocked([&] { return checkScene(self.scene()); }))
                     list.emplace_back(std::move(finding.where), std::move(finding.message));
                 return list;
             })
        .def(
            "__eq__", [](const SceneHandle& self, const SceneHandle& other) { return self.scene() == other.scene(); },
            nb::is_operator());

    nb::class_<RenderOptions>(module, "RenderOptions")
        .def(
            "__init__",
            [](RenderOptions* self, const ProfileHandle* profile)
            {
                new (self) RenderOptions();
                if (profile != nullptr)
                    self->profile = profile->profile();
            },
            "profile"_a.none())
        .def("set", &RenderOptions::set, "sample_rate"_a, "tolerance"_a, "leave_out"_a, "adapt"_a, "mapping"_a.none(),
             "max_boost"_a, "strength"_a, "protect"_a)
        .def("adjust", &RenderOptions::adjust, "gain"_a, "transpose"_a, "stretch"_a, "delay"_a, "variation"_a,
             "variation_per"_a, "seed"_a)
        .def("decode", &RenderOptions::decode, "carriers"_a.none(), "follow_envelope"_a.none(), "pulse"_a.none(),
             "pulse_frequency"_a.none(), "pulse_cycles"_a)
        .def("part", &RenderOptions::part, "start"_a, "end"_a.none())
        .def("feel", &RenderOptions::feel, "wearer"_a, "full_scale"_a);
    module.def(
        "render_clip",
        [](const ClipHandle& clip, const RenderOptions& options, nb::object progress)
        {
            Watch watch(std::move(progress));
            return handedOut(take(unlocked([&] { return rendered(sceneOf(clip.clip()), options, watch); })));
        },
        "clip"_a, "options"_a, "progress"_a.none());
    module.def(
        "render_scene",
        [](const SceneHandle& scene, const RenderOptions& options, nb::object progress)
        {
            Watch watch(std::move(progress));
            return handedOut(take(unlocked([&] { return rendered(scene.scene(), options, watch); })));
        },
        "scene"_a, "options"_a, "progress"_a.none());
    module.attr("STANDARD_STRENGTH") = standardStrength;
    module.attr("FELT_FULL_SCALE") = FeltParams().fullScale;
}

} // namespace pacini::python
