// A sound becomes the same clip whoever encodes it.

#include "cli/EncodeJob.h"
#include "document/Analysis.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/TempFolder.h"

#include <pacini/clip/PackedClip.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Command, plot, editor and arrays make one clip of a sound: on its grids, named in UTF-8, sealed", "[encode]")
{
    const TempFolder folder;
    const auto path = folder / "caf\xE9.wav"; // Latin-1
    const auto samples = sine(8000, 120.0, 16000.0, 0.4);
    REQUIRE(writeAudio(path, samples, {.sampleRate = 16000, .channels = 1}).ok());
    const auto nobody = [](double) {
    };
    cli::EncodeJob job({});
    REQUIRE(job.run(path, folder / "clip.json", Replaceable::named, nobody).ok());
    const Clip written = readClip(folder / "clip.json").value().clip;
    CHECK(onGrids(written) == written);
    CHECK(sealOf(written) == ClipSeal::whole);
    CHECK(written.source.file == "caf\xEF\xBF\xBD.wav");
    CHECK(written.name == "caf\xEF\xBF\xBD");

    CHECK(job.encode(path, nobody).value() == written);

    const auto described = describeAudio(path);
    REQUIRE(described);
    CHECK(analyse(described->audio, {}, described->reference).value() == written);

    SoundEncoder encoder({});
    SoundParts parts(samples, 1);
    Stopwatch work;
    CHECK(encoder.clipOf({16000, 1}, parts, clipNamesOf(path), work).value() == written);
}

TEST_CASE("Each method's clip is finished, whoever encodes it", "[encode]")
{
    const auto samples = sine(8000, 120.0, 16000.0, 0.4);
    for (const MethodInfo& info : methodTable)
    {
        if (info.output != MethodOutput::clip)
            continue;
        SoundEncoderParams params;
        params.method = methodNamed(info.name).value();
        SoundEncoder encoder(params);
        SoundParts parts(samples, 1);
        Stopwatch work;
        const auto clip = encoder.clipOf({16000, 1}, parts, {"a", "a.wav"}, work);
        REQUIRE(clip);
        CHECK(onGrids(*clip) == *clip);
        CHECK(sealOf(*clip) == ClipSeal::whole);
    }
}
