#include "support/Catch.h"

#include <pacini/evaluate/SectionCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Random.h>

#include <vector>

using namespace pacini;

TEST_CASE("A cascade of a known number of sections filters as the streaming one does, in one call or many",
          "[evaluate]")
{
    const double fs = 4000.0;
    const ButterworthParams params{ButterworthType::bandpass, 2, Hertz(60.0), Hertz(125.0)};
    const auto design = designButterworth(params, fs);
    REQUIRE(design.sections.size() == 2);
    Random random(11);
    std::vector<float> x(3000), expected(x.size());
    for (float& v : x)
        v = static_cast<float>(random.uniform(-1.0, 1.0));
    Butterworth streaming;
    streaming.prepare({fs, x.size()});
    streaming.setParams(params);
    streaming.process(x, expected);

    SectionCascade<2> cascade({design.sections[0].directForm(), design.sections[1].directForm()});
    auto y = x;
    cascade.process(std::span(y).first(1234));
    cascade.process(std::span(y).subspan(1234));
    for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(static_cast<double>(y[i]) == Approx(static_cast<double>(expected[i])).margin(1e-7));
}
