// Actuator profiles: shipped ones and files.

#include "io/AcfFile.h"
#include "io/ProfileFile.h"
#include "io/ProfileJson.h"
#include "io/ShippedProfiles.h"
#include "python/native/Overwriting.h"
#include "python/native/ProfileHandle.h"
#include "python/native/Support.h"

#include <pacini/actuator/Equalizer.h>
#include <pacini/foundation/Units.h>

#include <nanobind/operators.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
std::pair<ProfileHandle, std::vector<std::string>> readFile(const std::filesystem::path& path, bool strict)
{
    if (hasAcfExtension(path))
    {
        auto acf = takeIn(path, readAcfFile(path));
        return {ProfileHandle(std::move(acf.profile)), acf.warnings};
    }
    ReadWarnings warnings(strict);
    auto profile = takeIn(path, readProfile(path, &warnings));
    return {ProfileHandle(std::move(profile)), warnings.texts()};
}

ProfileHandle shipped(const std::string& name)
{
    std::string names;
    for (const NamedProfile& one : builtInProfiles())
    {
        if (one.name == name)
            return ProfileHandle(*one.profile);
        names += (names.empty() ? "" : ", ") + one.name;
    }
    raise({ErrorCode::io, "profile", "is neither a file nor one of " + names});
}

std::vector<std::string> shippedNames()
{
    std::vector<std::string> names;
    for (const NamedProfile& one : builtInProfiles())
        names.push_back(one.name);
    return names;
}
} // namespace

void bindProfile(nb::module_& module)
{
    nb::class_<ProfileHandle>(module, "ProfileHandle")
        .def_static(
            "from_json",
            [](const std::string& text)
            {
                ReadWarnings strict(true);
                return ProfileHandle(take(readProfileJson(text, &strict)));
            },
            "text"_a)
        .def_static("read", &readFile, "path"_a, "strict"_a)
        .def_static("shipped", &shipped, "name"_a)
        .def("to_json", [](const ProfileHandle& self) { return profileJson(self.profile()); })
        .def(
            "save",
            [](const ProfileHandle& self, const std::filesystem::path& path, Overwrite overwrite)
            {
                const Existing existing = mayWrite(path, FileKind::profile, overwrite);
                take(validate(self.profile()));
                return take(writeFileAtomically(path, profileJson(self.profile()), existing));
            },
            "path"_a, "overwrite"_a.none())
        .def_prop_ro("name", [](const ProfileHandle& self) { return self.profile().name; })
        .def(
            "equalizer_response",
            [](const ProfileHandle& self, const std::vector<double>& frequencies, double rate)
            {
                if (!isPlayableRate(rate))
                    raise({ErrorCode::invalidArgument, "sample_rate", "must be 2000 to 768000 Hz"});
                const auto filter = designEqualizer(self.profile().equalizer, rate);
                std::vector<double> decibels;
                for (const double frequency : frequencies)
                    decibels.push_back(Decibels::fromGain(std::abs(filter.response(Hertz(frequency), rate))).value);
                return toArray(std::move(decibels));
            },
            "frequencies"_a, "sample_rate"_a)
        .def(
            "__eq__",
            [](const ProfileHandle& self, const ProfileHandle& other) { return self.profile() == other.profile(); },
            nb::is_operator());
    module.def("profile_names", &shippedNames);
}

} // namespace pacini::python
