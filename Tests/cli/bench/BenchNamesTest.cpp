#include "cli/BenchOptions.h"
#include "cli/bench/Bench.h"
#include "support/Catch.h"

#include <string_view>
#include <vector>

using namespace pacini::cli;

TEST_CASE("The command names just the benchmarks that its program has", "[bench]")
{
    std::vector<std::string_view> names;
    const auto benches = allBenches();
    for (const Bench& bench : benches)
        names.push_back(bench.name);
    CHECK(names == std::vector<std::string_view>(benchNames.begin(), benchNames.end()));
}
