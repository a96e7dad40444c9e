#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/CarrierSection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
struct SectionAim
{
    std::vector<double> gains;
    double transposition = 1.0;
    double attack = 0.7, release = 0.2;
    bool level = true;
};

/// What a section plays of tones that come and go and a noise, aimed anew with every hop.
std::vector<double> sectionPlays(CarrierSection& section, std::size_t hops,
                                 const std::function<SectionAim(std::size_t)>& aimOf)
{
    std::vector<double> all;
    Random random(12);
    const double fs = 6000.0, turn = 2.0 * std::numbers::pi;
    for (std::size_t hop = 0; hop < hops; ++hop)
    {
        std::array<double, controlHop> in{}, out{};
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            const double t = static_cast<double>(hop * controlHop + i) / fs;
            in[i] = (hop % 90 < 60 ? 0.4 * std::sin(turn * 70.0 * t) : 0.0) +
                    (hop % 70 < 40 ? 0.3 * std::sin(turn * 260.0 * t) : 0.0) +
                    (hop % 110 > 60 ? 0.25 * std::sin(turn * 600.0 * t) : 0.0) + 0.02 * random.uniform(-1.0, 1.0);
        }
        const SectionAim aim = aimOf(hop);
        section.aim(aim.gains, aim.transposition, aim.attack, aim.release, aim.level ? 1.0 : 0.0);
        section.process(std::span(in).first(5), std::span(out).first(5), 0);
        section.process(std::span(in).subspan(5), std::span(out).subspan(5), 5);
        section.flush();
        all.insert(all.end(), out.begin(), out.end());
    }
    return all;
}

TranslatorSetup sectionSetup(std::size_t bands, int polyphony)
{
    TranslatorSetup setup;
    setup.bands.bands = bands;
    setup.bands.low = Hertz(50.0);
    if (polyphony > 0)
    {
        setup.maxBoost = Decibels(0.0);
        Profile& profile = setup.profile.emplace();
        profile.technology = Technology::vca;
        profile.range = {60.0, 300.0, 60.0};
        profile.polyphony = polyphony;
    }
    return setup;
}

void pinSection(const std::string& name, const TranslatorSetup& setup,
                const std::function<SectionAim(std::size_t)>& aimOf)
{
    const TranslatorDesign design = designTranslator(setup, 6000.0);
    CarrierSection section;
    section.adopt(design);
    const auto all = sectionPlays(section, 330, aimOf);
    CHECK(*std::max_element(all.begin(), all.end()) > 0.1);
    for (std::size_t part = 0; part < 3; ++part)
        checkPinned("realtime/carriers, " + name + ", part " + std::to_string(part),
                    std::span(all).subspan(part * all.size() / 3, all.size() / 3), 1e-6);
    section.reset();
    CHECK(sectionPlays(section, 330, aimOf) == all);
}
} // namespace

TEST_CASE("carriers play what they played before, whoever of them is wanted", "[realtime]")
{
    pinSection("all", sectionSetup(6, 0), [](std::size_t) { return SectionAim{std::vector<double>(6, 1.0)}; });
    pinSection("not levelled", sectionSetup(6, 0),
               [](std::size_t) {
                   return SectionAim{std::vector<double>(6, 0.7), 1.0, 0.5, 0.1, false};
               });
    pinSection("the lowest alone", sectionSetup(3, 0), [](std::size_t) { return SectionAim{{1.0, 0.0, 0.0}}; });
    pinSection("the highest alone", sectionSetup(3, 0),
               [](std::size_t) {
                   return SectionAim{{0.0, 0.0, 1.5}, 1.5, 1.0, 1.0, false};
               });
    pinSection("in turns", sectionSetup(4, 0),
               [](std::size_t hop)
               {
                   SectionAim aim{{1.0, 0.5, 0.0, 1.2}, 0.8, 0.6, 0.1, hop / 50 % 2 == 0};
                   std::rotate(aim.gains.begin(), aim.gains.begin() + static_cast<std::ptrdiff_t>(hop / 40 % 4),
                               aim.gains.end());
                   if (hop / 30 % 5 == 4)
                       aim.gains.assign(4, 0.0);
                   return aim;
               });
    pinSection("twelve", sectionSetup(12, 0),
               [](std::size_t) {
                   return SectionAim{std::vector<double>(12, 1.0), 1.1};
               });
}

TEST_CASE("carriers share few voices as before", "[realtime]")
{
    for (const int voices : {1, 2, 3})
        for (const bool level : {false, true})
            pinSection(std::to_string(voices) + (level ? " voices, levelled" : " voices"), sectionSetup(8, voices),
                       [level](std::size_t hop)
                       {
                           SectionAim aim{std::vector<double>(8, 1.0), hop < 200 ? 1.0 : 1.3, 0.7, 0.3, level};
                           aim.gains[2] = hop < 100 ? 0.0 : 2.0;
                           return aim;
                       });
}

TEST_CASE("carriers that nobody wants are silent, and one for a tone between two centres is one tone", "[realtime]")
{
    const TranslatorDesign design = designTranslator(sectionSetup(6, 0), 6000.0);
    CarrierSection section;
    section.adopt(design);
    for (const double y :
         sectionPlays(section, 100, [](std::size_t) { return SectionAim{std::vector<double>(6, 0.0)}; }))
        REQUIRE(y == 0.0);
    // What sounded dies away exactly.
    (void)sectionPlays(section, 100, [](std::size_t) { return SectionAim{std::vector<double>(6, 1.0)}; });
    const auto rest = sectionPlays(section, 300,
                                   [](std::size_t) {
                                       return SectionAim{std::vector<double>(6, 0.0), 1.0, 0.7, 0.5};
                                   });
    for (std::size_t n = rest.size() / 2; n < rest.size(); ++n)
        REQUIRE(rest[n] == 0.0);
}
