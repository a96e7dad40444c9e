#include "support/Catch.h"

#include <pacini/analysis/Encoder.h>

using namespace pacini;

TEST_CASE("Events are scaled by the gain and keep their ratios", "[analysis]")
{
    const std::vector<Onset> onsets = {{0.1, 0.2, 0.2, 0.0, 2.0}, {0.5, 0.1, 0.1, 0.3, 2.0}};
    const auto transients = transientsFrom(onsets, 3.0);
    REQUIRE(transients.size() == 2);
    CHECK(transients[0].time == 0.1);
    CHECK(transients[0].amplitude == Approx(0.6));
    CHECK(transients[1].amplitude == Approx(0.3));
    CHECK(transients[1].sharpness == 0.3);
}

TEST_CASE("Bright events are felt at half their level, and never above full drive", "[analysis]")
{
    const auto quiet = transientsFrom(std::vector<Onset>{{0.0, 0.4, 0.01, 1.0, 2.0}}, 1.0);
    CHECK(quiet[0].amplitude == Approx(0.2));
    const auto loud = transientsFrom(std::vector<Onset>{{0.0, 0.8, 0.01, 1.0, 2.0}, {0.2, 0.4, 0.01, 1.0, 2.0}}, 10.0);
    CHECK(loud[0].amplitude == Approx(1.0));
    CHECK(loud[1].amplitude == Approx(0.5));
    CHECK(transientsFrom(std::vector<Onset>{{0.0, 1.0, 1.0, 0.0, 2.0}}, 5.0)[0].amplitude == 1.0);
}

TEST_CASE("The envelope is held down between the hits of a train and left alone elsewhere", "[analysis]")
{
    // Frames of 5 ms; a train at 20, 50 and 80 ms, and two close hits that are none, at 300 and 330 ms.
    std::vector<float> envelope(80, 0.5f);
    envelope[62] = 0.3f;
    envelope[4] = 1.0f;
    envelope[6] = 0.2f;
    envelope[12] = 0.1f;
    const std::vector<float> before = envelope;
    const std::vector<Onset> onsets = {
        {0.020, 1, 1, 0, 2}, {0.050, 1, 1, 0, 2}, {0.080, 1, 1, 0, 2}, {0.3, 1, 1, 0, 2}, {0.33, 1, 1, 0, 2}};
    holdDownBetween(onsets, std::vector<TrainSpan>{{0.02, 0.08}}, 0.005, envelope);
    for (std::size_t i = 3; i < 9; ++i)
        CHECK(envelope[i] == 0.2f);
    for (std::size_t i = 9; i < 15; ++i)
        CHECK(envelope[i] == 0.1f);
    for (std::size_t i = 15; i < envelope.size(); ++i)
        CHECK(envelope[i] == before[i]);
    CHECK(envelope[2] == before[2]);
}

TEST_CASE("Events at the ends of the envelope stay inside it", "[analysis]")
{
    std::vector<float> envelope(4, 1.0f);
    holdDownBetween(std::vector<Onset>{{0.0, 1, 1, 0, 2}, {0.019, 1, 1, 0, 2}, {0.04, 1, 1, 0, 2}},
                    std::vector<TrainSpan>{{0.0, 0.04}}, 0.005, envelope);
    CHECK(envelope.size() == 4);
    holdDownBetween({}, {}, 0.005, envelope);
    holdDownBetween({}, std::vector<TrainSpan>{{0.0, 0.04}}, 0.005, envelope);
    std::vector<float> none;
    holdDownBetween(std::vector<Onset>{{0.0, 1, 1, 0, 2}, {0.01, 1, 1, 0, 2}}, std::vector<TrainSpan>{{0.0, 0.01}},
                    0.005, none);
    CHECK(none.empty());
}
