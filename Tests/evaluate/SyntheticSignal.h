#pragma once

// The synthetic signals that the golden values of the measures belong to (see the description in golden/judge.json).

#include <pacini/foundation/Random.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace pacini::test
{

inline std::vector<double> syntheticSignal(const nlohmann::json& description)
{
    std::vector<double> x(description["frames"].get<std::size_t>());
    const double rate = description["rate"];
    for (const auto& partial : description.value("partials", nlohmann::json::array()))
    {
        const auto [onset, frequency, amplitude, decay] = partial.get<std::array<double, 4>>();
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            const double t = static_cast<double>(i) / rate;
            if (t >= onset)
                x[i] += amplitude * std::exp(-decay * (t - onset)) * std::sin(2.0 * std::numbers::pi * frequency * t);
        }
    }
    if (description.contains("noise"))
    {
        Random random(description["noise"][0].get<std::uint64_t>());
        const double amplitude = description["noise"][1];
        for (double& v : x)
            v += amplitude * (2.0 * random.uniform() - 1.0);
    }
    for (double& v : x)
        v += description.value("offset", 0.0);
    for (const auto& at : description.value("notANumber", nlohmann::json::array()))
        x[at.get<std::size_t>()] = std::numeric_limits<double>::quiet_NaN();
    for (const auto& at : description.value("infinite", nlohmann::json::array()))
        x[at.get<std::size_t>()] = std::numeric_limits<double>::infinity();
    return x;
}

} // namespace pacini::test
