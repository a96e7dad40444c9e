#include "support/Catch.h"

#include <pacini/foundation/SnakeCase.h>

TEST_CASE("Plain names get snake case, paths in files stay as they are")
{
    CHECK(pacini::snakeCase("maxPlays") == "max_plays");
    CHECK(pacini::snakeCase("fadeIn") == "fade_in");
    for (const char* same : {"", "gain", "pan_law", "actuators[1].gain", "bands[2].lowFrequency", "budget.perFrame"})
        CHECK(pacini::snakeCase(same) == same);
}
