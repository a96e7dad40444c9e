// Live translator, block by block.

#include "io/LiveSettings.h"
#include "io/NearestName.h"
#include "python/native/Options.h"
#include "python/native/ProfileHandle.h"
#include "python/native/Support.h"

#include <pacini/realtime/Translator.h>
#include <pacini/realtime/TranslatorPresets.h>
#include <pacini/realtime/TranslatorSetupParameters.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
nb::dict dictOf(const TranslatorParams& params)
{
    nb::dict result;
    for (const auto& parameter : translatorParameters)
    {
        const nb::str name(separatedName(parameter.name, '_').c_str());
        if (parameter.kind == ParameterKind::truth)
            result[name] = parameter.get(params) != 0.0;
        else
            result[name] = parameter.get(params);
    }
    return result;
}

/// Sets one parameter by its name. Errors: invalidArgument for names that are none, and what is out of range.
void set(TranslatorParams& params, const std::string& name, nb::handle value)
{
    std::vector<std::string> names;
    for (const auto& parameter : translatorParameters)
    {
        names.push_back(separatedName(parameter.name, '_'));
        if (names.back() != name)
            continue;
        nb::dict given;
        given[nb::str(name.c_str())] = value;
        const ParameterInfo* const one = &parameter;
        for (const auto& [_, number] : givenOptions(given, std::span(&one, 1)))
            parameter.set(params, number);
        return;
    }
    raise({ErrorCode::invalidArgument, name, "is not a parameter of the translator" + meantText(name, names)});
}

/// A translator with its parameters, for creating it again. One thread at a time; others wait.
class TranslatorHandle
{
public:
    /// `options`: bands, boost and strength.
    TranslatorHandle(double rate, const ProfileHandle* profile, const nb::dict& options)
    {
        if (!isPlayableRate(rate))
            raise({ErrorCode::invalidArgument, "sample_rate", "must be 2000 to 768000 Hz"});
        TranslatorSetup setup;
        if (profile != nullptr)
            setup.profile = profile->profile();
        for (const auto& [parameter, value] : givenOptions(options, infosOf(translatorSetupParameters)))
            parameterNamed(translatorSetupParameters, parameter->name).set(setup, value);
        ProcessSpec spec;
        spec.sampleRate = rate;
        translator.setSetup(setup);
        translator.prepare(spec);
        translator.reset();
    }

    [[nodiscard]] nb::object process(const SoundArray& array)
    {
        const SoundView sound = soundOf(array);
        if (sound.channels != 1)
            raise({ErrorCode::invalidArgument, "sound", "must be mono: (frames,)"});
        std::vector<float> out(sound.frames);
        Watch watch{nb::none()};
        unlocked(
            [&]
            {
                const std::scoped_lock lock(mutex);
                ArrayParts parts(sound, Unsound::keep, watch); // the translator takes what is no number as 0
                for (std::size_t done = 0; done < out.size();)
                {
                    const auto part = parts();
                    translator.process(*part, std::span(out).subspan(done, part->size()));
                    done += part->size();
                }
            });
        return toArray(std::move(out));
    }

    [[nodiscard]] nb::dict params() const { return dictOf(current); }

    void setParams(const nb::dict& changes)
    {
        TranslatorParams wanted = current;
        for (const auto& [name, value] : changes)
            set(wanted, nb::cast<std::string>(name), value);
        const std::scoped_lock lock(mutex);
        current = wanted;
        translator.setParams(current);
    }

    void reset()
    {
        const std::scoped_lock lock(mutex);
        translator.reset();
    }

    [[nodiscard]] std::size_t latency() const { return translator.latencyFrames(); }

    [[nodiscard]] nb::dict meters() const
    {
        const TranslatorMeterReading reading = translator.meters().read();
        nb::dict result;
        std::vector<double> bands(reading.bandLevels.begin(),
                                  reading.bandLevels.begin() + static_cast<std::ptrdiff_t>(reading.bands));
        result["bands"] = bands;
        result["events"] = reading.events;
        result["output_peak"] = reading.outputPeak;
        result["gain_reduction"] = reading.gainReduction;
        result["over_threshold"] = reading.overThreshold;
        return result;
    }

    [[nodiscard]] std::vector<std::pair<std::string, std::string>> savings() const
    {
        std::vector<std::pair<std::string, std::string>> list;
        for (const TranslatorSaving& saving : translator.plan(current))
            list.emplace_back(saving.what, saving.reason);
        return list;
    }

private:
    std::mutex mutex;
    Translator translator;
    TranslatorParams current;
};

/// The live parameters of the text of a settings document, and what was let pass.
std::pair<nb::dict, std::vector<std::string>> settingsOf(const std::string& text)
{
    ReadWarnings warnings;
    return {dictOf(take(liveParamsOf(take(readSettings(text, &warnings))))), warnings.texts()};
}

std::vector<std::pair<std::string, nb::dict>> presets()
{
    std::vector<std::pair<std::string, nb::dict>> list;
    for (const TranslatorPreset& preset : translatorPresets())
        list.emplace_back(preset.name, dictOf(preset.params));
    return list;
}
} // namespace

void bindTranslator(nb::module_& module)
{
    nb::class_<TranslatorHandle>(module, "TranslatorHandle")
        .def(nb::init<double, const ProfileHandle*, const nb::dict&>(), "sample_rate"_a, "profile"_a.none(),
             "options"_a)
        .def("process", &TranslatorHandle::process, "sound"_a)
        .def("params", &TranslatorHandle::params)
        .def("set_params", &TranslatorHandle::setParams, "changes"_a)
        .def("reset", &TranslatorHandle::reset)
        .def_prop_ro("latency", &TranslatorHandle::latency)
        .def("meters", &TranslatorHandle::meters)
        .def("savings", &TranslatorHandle::savings);
    module.def("translator_presets", &presets);
    module.def("translator_settings", &settingsOf, "text"_a);
    module.def("translator_parameters", [] { return descriptionsJson(infosOf(translatorParameters)).dump(); });
    module.def("translator_setup_parameters",
               [] { return descriptionsJson(infosOf(translatorSetupParameters)).dump(); });
}

} // namespace pacini::python
