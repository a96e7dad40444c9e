// Scenes, and rendering of clips and scenes as drive signals or as the acceleration of the skin.

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
#include <pacini/synthesis/Transparency.h>

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

/// Rendering options.
struct RenderOptions : RenderParams
{
    RenderOptions(const ProfileHandle* actuator, const nb::dict& options)
    {
        if (actuator != nullptr)
            profile = actuator->profile();
        given = givenOptions(options, infosOf(renderParameters));
        for (const auto& [parameter, value] : given)
            parameterNamed(renderParameters, parameter->name).set(*this, value);
        takeNamed(checkPart(*this));
    }

    /// What no table describes. Raises pacini.Error for a parameter without effect; all come here, so that those with
    /// the usual value do not count as given.
    void set(bool protectIt, bool leaveOut, bool adapt, std::uint64_t seed)
    {
        protect = protectIt;
        compile.leaveOut = leaveOut;
        compile.adapt = adapt;
        adjustment.variation.seed = seed;
        for (const auto& [parameter, value] : given)
            if (value != parameter->usual())
                takeNamed(checkEffect(parameterNamed(renderParameters, parameter->name), *this, profile.has_value()));
    }

    void feel(const nb::dict& options)
    {
        felt.emplace();
        for (const auto& [parameter, value] : givenOptions(options, infosOf(feltParameters)))
            parameterNamed(feltParameters, parameter->name).set(*felt, value);
    }

    std::optional<Profile> profile;

private:
    GivenParameters given;
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

nb::list handedOut(const std::vector<Adaptation>& adaptations)
{
    nb::list made;
    for (const Adaptation& adaptation : adaptations)
        made.append(nb::make_tuple(adaptation.where, adaptation.what));
    return made;
}

nb::object handedOut(RenderedScene&& made)
{
    const RenderReport& report = made.report;
    nb::list leftOut, unplayable;
    for (const LeftOut& item : report.leftOut)
    {
        leftOut.append(nb::make_tuple(item.where, item.reason, item.error));
        if (item.unplayable && item.isWholePlay())
            unplayable.append(item.where + " " + item.reason);
    }
    return nb::make_tuple(toArray(std::move(made.samples), {report.actuators, static_cast<std::size_t>(report.frames)}),
                          report.reduction, report.predictedError, handedOut(report.adaptations), leftOut, unplayable);
}

/// The scene as it feels on the actuator of `options` as it did on `designed`, what was done, and what cannot be.
nb::object transparent(const SceneHandle& scene, const ProfileHandle& designed, const RenderOptions& options)
{
    if (!options.profile)
        wrong("designed_for", "needs a profile, the actuator that shall feel alike");
    if (!options.compile.adapt)
        wrong("designed_for", "excludes adapt=False");
    auto made = unlocked(
        [&]
        { return transparentScene(scene.scene(), designed.profile(), *options.profile, options.compile.adaptation); });
    if (!made)
    {
        Error error = made.error();
        error.where = (error.where.starts_with("from.") ? "designed_for: " : "profile: ") +
                      error.where.substr(error.where.find('.') + 1);
        raise(error);
    }
    return nb::make_tuple(SceneHandle(std::move(made->scene)), handedOut(made->changes), handedOut(made->lost));
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
            return Error{ErrorCode::invalidData, "", "is not one of the clips"};
        return clips[index].clip();
    };
}

void bindScene(nb::module_& module)
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
                auto scene = takeIn(path, unlocked([&] { return readScene(path, clipFolder, &warnings); }));
                return std::pair(SceneHandle(std::move(scene)), warnings.texts());
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
}
} // namespace

void bindRender(nb::module_& module)
{
    bindScene(module);
    nb::class_<RenderOptions>(module, "RenderOptions")
        .def(nb::init<const ProfileHandle*, const nb::dict&>(), "profile"_a.none(), "options"_a)
        .def("set", &RenderOptions::set, "protect"_a, "leave_out"_a, "adapt"_a, "seed"_a)
        .def("feel", &RenderOptions::feel, "options"_a);
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
    module.def("transparent", &transparent, "scene"_a, "designed_for"_a, "options"_a);
    module.def("render_parameters", [] { return descriptionsJson(infosOf(renderParameters)).dump(); });
    module.def("felt_parameters", [] { return descriptionsJson(infosOf(feltParameters)).dump(); });
    module.attr("STANDARD_STRENGTH") = standardStrength;
    module.attr("FELT_FULL_SCALE") = FeltParams().fullScale;
}

} // namespace pacini::python
