#include "io/AudioReader.h"
#include "io/TagBytes.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// The Ogg file with all times of its audio earlier by that many frames.
std::string earlier(const std::string& bytes, std::int64_t frames)
{
    std::string all;
    std::uint32_t number = 0;
    for (std::size_t at = 0; at + 27 <= bytes.size();)
    {
        const auto laces = static_cast<unsigned char>(bytes[at + 26]);
        const auto lengths = bytes.substr(at + 27, laces);
        std::size_t content = 0;
        for (const char lace : lengths)
            content += static_cast<unsigned char>(lace);
        std::string head = bytes.substr(at, 26);
        std::int64_t time = 0;
        for (std::size_t i = 8; i-- > 0;)
            time = static_cast<std::int64_t>(static_cast<std::uint64_t>(time) << 8u |
                                             static_cast<unsigned char>(head[6 + i]));
        if (time > 0)
            head.replace(6, 8, littleEndian(static_cast<std::uint64_t>(time - frames), 8));
        all += oggPageBytes(head, lengths, bytes.substr(at + 27 + laces, content), number++);
        at += 27u + laces + content;
    }
    return all;
}
} // namespace

TEST_CASE("An Ogg whose times begin before its start is read whole, or less what an edit leaves out", "[io][audio]")
{
    const TempFolder folder;
    const auto ogg = bytesOf(testFolder() / "io/audio/tone.ogg");
    const auto whole = readAudio(put(folder / "x", ogg));
    REQUIRE(whole.ok());
    REQUIRE((readAudio(put(folder / "x", earlier(ogg, 0)))->samples == whole->samples));

    // The first packets of this one overlap by at most 2048 frames.
    const auto rate = static_cast<double>(whole->sampleRate);
    for (const std::int64_t frames : {2100, 5000, 9000, 100'000})
    {
        CAPTURE(frames);
        const auto audio = readAudio(put(folder / "x", earlier(ogg, frames)));
        REQUIRE(audio.ok());
        CHECK((audio->samples == whole->samples));
        REQUIRE(audio->warnings.size() == 1);
        CHECK(
            audio->warnings.front() ==
            fmt::format("has times by which its first {:.3f} s lie before its start, more than an edit can; all of it "
                        "is read; save it anew",
                        static_cast<double>(frames) / rate));
    }
    // An edit at the start, as the standard allows it.
    const auto edited = readAudio(put(folder / "x", earlier(ogg, 30)));
    REQUIRE(edited.ok());
    CHECK(edited->warnings.empty());
    const auto left = static_cast<std::ptrdiff_t>(30 * whole->channels);
    CHECK((edited->samples == std::vector<float>(whole->samples.begin() + left, whole->samples.end())));
    // A later start, as of a broadcast.
    const auto late = readAudio(put(folder / "x", earlier(ogg, -5000)));
    REQUIRE(late.ok());
    CHECK(late->warnings.empty());
    CHECK((late->samples == whole->samples));
    // Behind another stream, which has times of its own.
    const auto second = readAudio(put(folder / "x", ogg + earlier(ogg, 5000)));
    REQUIRE(second.ok());
    CHECK(second->samples.size() == 2 * whole->samples.size());
    CHECK(second->warnings.size() == 1);
}

TEST_CASE("Damage within an Ogg whose times begin before its start is still told", "[io][audio]")
{
    const TempFolder folder;
    auto ogg = earlier(bytesOf(testFolder() / "io/audio/tone.ogg"), 5000);
    const auto pages = oggPages(ogg).size();
    REQUIRE(pages > 3);
    ogg[ogg.size() - 40] = static_cast<char>(ogg[ogg.size() - 40] ^ 0x55);
    const auto audio = readAudio(put(folder / "x", ogg));
    CHECK((!audio.ok() || audio->warnings.size() > 1));
}
