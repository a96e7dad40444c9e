#pragma once

// Valid profiles with everything in them, for round trips.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace pacini::test
{

/// A valid profile; every group is there or not by chance, numbers have all their digits.
inline Profile randomProfile(std::uint64_t seed)
{
    Random random(seed);
    const auto chance = [&]
    {
        return random.next() % 2 == 0;
    };
    const auto whole = [&](int low, int high)
    {
        return low + static_cast<int>(random.next() % static_cast<std::uint64_t>(high - low + 1));
    };
    const auto wide = [&](double low, double high)
    {
        return std::exp(random.uniform(std::log(low * 1.0001), std::log(high * 0.9999)));
    };
    const auto maybe = [&](double low, double high)
    {
        return chance() ? std::optional(wide(low, high)) : std::nullopt;
    };

    Profile profile;
    profile.name = "Zwölf \"Spulen\" \\ 触覚 \n\t\x01 " + std::to_string(seed);
    if (seed % 2 == 0)
        profile.shortName = "Spule \"触\" " + std::to_string(seed);
    profile.technology = static_cast<Technology>(whole(0, 5));
    profile.resonance = {wide(1.0, 20000.0), wide(0.01, 100.0)};
    profile.range.lowFrequency = wide(1.0, 10000.0);
    profile.range.highFrequency = wide(profile.range.lowFrequency * 1.01, 20000.0);
    profile.range.dynamicRange = random.uniform(1.0, 140.0);
    if (chance())
        profile.response = {random.uniform(0.0, 2.0), random.uniform(0.0, 2.0)};
    profile.polyphony = whole(0, 64);
    profile.frequencyMapping = static_cast<FrequencyMapping>(whole(0, 2));
    ActuatorDrive& drive = profile.drive;
    drive.impedance = maybe(0.1, 1e6);
    drive.maxVoltageRms = maybe(1e-3, 1e3);
    if (drive.impedance && drive.maxVoltageRms)
        drive.maxPower = maybe(1e-6, 1e3);
    drive.thermalTime = maybe(0.01, 1e4);
    drive.excursion = maybe(1e-9, 1.0);
    if (drive.excursion)
        drive.maxExcursion = maybe(1e-7, 0.1);
    drive.overdrive = chance() ? random.uniform(1.0, 10.0) : 1.0;
    for (int i = whole(0, 16); i > 0; --i)
    {
        EqualizerSection section;
        section.type = static_cast<EqualizerType>(whole(0, 3));
        section.frequency = wide(1.0, 20000.0);
        section.gain = random.uniform(-40.0, 40.0);
        section.q = wide(0.01, 100.0);
        section.order = whole(1, 4);
        profile.equalizer.pushBack(section);
    }
    if (chance())
        profile.transient = {static_cast<TransientShape>(whole(0, 2)), wide(1.0, 2000.0), wide(0.1, 100.0)};
    if (chance())
        profile.body = BodyParams{wide(1e-6, 1e3),
                                  wide(1e-7, 10.0),
                                  wide(1e-6, 100.0),
                                  wide(1.0, 1e13),
                                  chance() ? 0.0 : wide(1e-3, 1e9),
                                  wide(1e-7, 100.0),
                                  chance() ? 0.0 : wide(1.0, 1e9),
                                  chance() ? 0.0 : wide(1e-3, 1e6)};
    if (chance())
    {
        ProfileMeasurement& measured = profile.measurement.emplace();
        measured.placements = whole(1, 1000000);
        measured.drive = random.uniform(-200.0, 40.0);
        if (chance())
            measured.distortionDrive = random.uniform(-200.0, 40.0);
        if (chance())
        {
            const auto level = [&]
            {
                return random.uniform(-400.0, 400.0);
            };
            measured.linearity = Linearity{wide(0.1, 2e5), wide(0.1, 2e5), random.uniform(0.0, 100.0),
                                           level(),        level(),        level(),
                                           level(),        wide(0.1, 2e5), {}};
            for (int i = whole(0, 3); i > 0; --i)
                measured.linearity->outliers.push_back({wide(0.1, 2e5), wide(0.1, 2e5), level()});
        }
        double frequency = wide(0.1, 10.0);
        for (int i = whole(0, 5); i > 0; --i, frequency *= wide(1.01, 2.0))
            measured.points.push_back({frequency, random.uniform(-400.0, 400.0),
                                       chance() ? std::optional(random.uniform(-400.0, 400.0)) : std::nullopt});
    }
    for (const char* path : {"body", "drive.overdrive", "resonance", "ä \"\\\n", "ö"})
        if (chance())
            profile.sources.push_back({path, "assumed: \"ü\" \x02"});
    return profile;
}

} // namespace pacini::test
