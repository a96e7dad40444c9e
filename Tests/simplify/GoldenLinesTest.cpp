#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/Optimal.h>
#include <pacini/simplify/Refit.h>
#include <pacini/simplify/Visvalingam.h>

using namespace pacini;

TEST_CASE("Simplifiers keep the points and reach the errors of the independent reference", "[simplify]")
{
    const auto golden = test::golden("lines");
    const double tolerance = golden["tol"];
    for (const auto& example : golden["cases"])
    {
        const std::string name = example["polyline"];
        const std::size_t target = example["target"];
        CAPTURE(name, target);
        const std::vector<double> times = golden["polylines"][name]["t"];
        const std::vector<double> values = golden["polylines"][name]["v"];
        Curve dense;
        for (std::size_t i = 0; i < times.size(); ++i)
            dense.push_back({times[i], values[i]});

        const auto visvalingam = visvalingamToCount(dense, target);
        const auto douglasPeucker = douglasPeuckerToCount(dense, target);
        CHECK(visvalingam == example["vw"].get<KeptPoints>());
        CHECK(douglasPeucker == example["rdp"].get<KeptPoints>());
        if (!example.contains("optimal_max_error"))
            continue;
        const auto error = [&](const KeptPoints& kept)
        {
            return curveError(dense, curveOf(dense, kept));
        };
        CHECK(error(visvalingam).max == Approx(example["vw_max_error"].get<double>()).margin(tolerance));
        CHECK(error(visvalingam).rms == Approx(example["vw_rms_error"].get<double>()).margin(tolerance));
        CHECK(error(douglasPeucker).max == Approx(example["rdp_max_error"].get<double>()).margin(tolerance));
        CHECK(error(optimalToCount(dense, target)).max ==
              Approx(example["optimal_max_error"].get<double>()).margin(tolerance));
        if (example.contains("vw_refit_values"))
        {
            const auto fitted = refit(dense, curveOf(dense, visvalingam));
            const std::vector<double> expected = example["vw_refit_values"];
            REQUIRE(fitted.size() == expected.size());
            // The reference is printed to 8 decimals, and its ridge of 1e-9 pulls to 0 where ours pulls to the old
            // values.
            for (std::size_t k = 0; k < expected.size(); ++k)
                CHECK(std::abs(fitted[k].value - expected[k]) < tolerance * (1.0 + std::abs(expected[k])) + 0.5e-8);
        }
    }
}
