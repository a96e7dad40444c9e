// Textures: made of recordings, read and written, and played by speed and force.

#include "io/AtomicFile.h"
#include "io/TextureFile.h"
#include "python/native/Options.h"
#include "python/native/Overwriting.h"
#include "python/native/ProfileHandle.h"
#include "python/native/Support.h"

#include <pacini/synthesis/RenderTexture.h>
#include <pacini/texture/TextureAnalysis.h>

#include <nanobind/operators.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
/// A texture of the module: an immutable value.
struct TextureHandle
{
    std::shared_ptr<const Texture> texture;
};

TextureHandle held(Texture texture)
{
    return {std::make_shared<const Texture>(std::move(texture))};
}

/// Times and values, of the same length.
Curve curveOf(const std::vector<double>& times, const std::vector<double>& values)
{
    Curve curve;
    for (std::size_t i = 0; i < times.size(); ++i)
        curve.push_back({times[i], values[i]});
    return curve;
}

std::pair<TextureHandle, nb::dict> analyse(const SoundArray& array, int rate, const std::vector<double>& times,
                                           const std::vector<double>& speeds, const std::vector<double>& forces,
                                           const std::string& name, const nb::dict& options)
{
    TextureParams params;
    for (const auto& [parameter, value] : givenOptions(options, infosOf(textureParameters)))
        parameterNamed(textureParameters, parameter->name).set(params, value);
    std::vector<float> samples = monoOf(soundOf(array));
    TextureMotion motion{curveOf(times, speeds), {}};
    if (!forces.empty())
        motion.force = curveOf(times, forces);
    auto fit = take(abandonable([samples = std::move(samples), rate, motion, params]
                                { return analyseTexture(samples, rate, motion, params); }));
    fit.texture.name = name;
    nb::dict about;
    about["frames"] = fit.frames;
    about["pitch_assumed"] = fit.pitchAssumed;
    about["speed_law_assumed"] = fit.speedLawAssumed;
    about["force_law_assumed"] = fit.forceLawAssumed;
    about["warnings"] = fit.warnings;
    return {held(std::move(fit.texture)), about};
}

nb::object render(const TextureHandle& handle, const std::pair<std::vector<double>, std::vector<double>>& speed,
                  const std::pair<std::vector<double>, std::vector<double>>& force, const ProfileHandle* profile,
                  std::uint64_t seed, const nb::dict& options, nb::object progress)
{
    TextureRenderParams params;
    for (const auto& [parameter, value] : givenOptions(options, infosOf(textureRenderParameters)))
        parameterNamed(textureRenderParameters, parameter->name).set(params, value);
    const TextureCourse course{curveOf(speed.first, speed.second), curveOf(force.first, force.second)};
    std::optional<Profile> actuator;
    if (profile != nullptr)
        actuator = profile->profile();
    Watch watch(std::move(progress));
    std::vector<float> samples;
    auto rendered = unlocked(
        [&]
        {
            return renderTexture(*handle.texture, course, params, seed, actuator ? &*actuator : nullptr,
                                 [&](std::span<const float> part, double done) -> Result<void>
                                 {
                                     samples.insert(samples.end(), part.begin(), part.end());
                                     watch(done);
                                     return {};
                                 });
        });
    takeNamed(std::move(rendered));
    return toArray(std::move(samples));
}
} // namespace

void bindTextures(nb::module_& module)
{
    nb::class_<TextureHandle>(module, "TextureHandle")
        .def_static(
            "from_json", [](const std::string& text) { return held(take(readTextureJson(text))); }, "text"_a)
        .def_static(
            "read",
            [](const std::filesystem::path& path, bool strict)
            {
                ReadWarnings warnings(strict);
                auto texture = takeIn(path, unlocked([&] { return readTexture(path, &warnings); }));
                return std::pair(held(std::move(texture)), warnings.texts());
            },
            "path"_a, "strict"_a)
        .def("to_json", [](const TextureHandle& self) { return textureJson(*self.texture); })
        .def(
            "save",
            [](const TextureHandle& self, const std::filesystem::path& path, Overwrite overwrite)
            {
                const Existing existing = mayWrite(path, FileKind::texture, overwrite);
                return take(unlocked([&] { return writeFileAtomically(path, textureJson(*self.texture), existing); }));
            },
            "path"_a, "overwrite"_a.none())
        .def("render", &render, "speed"_a, "force"_a, "profile"_a.none(), "seed"_a, "options"_a, "progress"_a.none())
        .def(
            "__eq__",
            [](const TextureHandle& self, const TextureHandle& other) { return *self.texture == *other.texture; },
            nb::is_operator());
    module.def("texture_parameters", [] { return descriptionsJson(infosOf(textureParameters)).dump(); });
    module.def("analyse_texture", &analyse, "sound"_a, "sample_rate"_a, "times"_a, "speeds"_a, "forces"_a, "name"_a,
               "options"_a);
}

} // namespace pacini::python
