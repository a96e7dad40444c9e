#include "io/TextureFile.h"

#include "support/Catch.h"
#include "support/ChangedText.h"
#include "support/RandomTexture.h"
#include "support/Refused.h"

#include <pacini/texture/TexturePlayer.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace pacini;
using test::changed;

TEST_CASE("A texture comes back as it was written")
{
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        const Texture texture = test::randomTexture(seed);
        REQUIRE(validate(texture));
        const auto read = readTextureJson(textureJson(texture));
        REQUIRE(read);
        CHECK(*read == texture);
    }
}

TEST_CASE("A texture with something missing or wrong is refused at its name")
{
    Texture texture;
    texture.nodes = {{0.25, 0.5, {-0.5}}, {0.75, 0.125, {0.375, 0.625}}};
    const std::string good = textureJson(texture);
    REQUIRE(readTextureJson(good));
    const auto where = [](const std::string& text)
    {
        return test::refusedAt(readTextureJson(text));
    };
    for (const char* name : {"format", "version", "pitch", "levelBySpeed", "levelByForce", "nodes"})
        CHECK(where(changed(good, std::string("\"") + name + "\"", "\"other\"")) == name);
    for (const char* name : {"speed", "level", "reflection"})
        CHECK(where(changed(good, std::string("\"") + name + "\"", "\"other\"")) == "nodes[0]." + std::string(name));
    CHECK(where(changed(good, "pacini.texture", "pacini.clip")) == "format");
    CHECK(where(changed(good, "\"version\": 1", "\"version\": 2")) == "version");
    CHECK(where(changed(good, "\"fullSpeed\": 1", "\"fullSpeed\": 0")) == "fullSpeed");
    CHECK(where(changed(good, "\"fullForce\": 1", "\"fullForce\": -1")) == "fullForce");
    CHECK(where(changed(good, "\"pitch\": 1", "\"pitch\": 1.01")) == "pitch");
    CHECK(where(changed(good, "\"levelBySpeed\": 1", "\"levelBySpeed\": 0")) == "levelBySpeed");
    CHECK(where(changed(good, "\"levelByForce\": 0.5", "\"levelByForce\": 3.1")) == "levelByForce");
    CHECK(where(changed(good, "\"speed\": 0.75", "\"speed\": 0.25")) == "nodes[1].speed");
    CHECK(where(changed(good, "\"speed\": 0.75", "\"speed\": 1.5")) == "nodes[1].speed");
    CHECK(where(changed(good, "\"level\": 0.5", "\"level\": 0")) == "nodes[0].level");
    CHECK(where(changed(good, "\"level\": 0.5", "\"level\": 1001")) == "nodes[0].level");
    CHECK(where(changed(good, "0.625]", "1]")) == "nodes[1].reflection[1]");
    CHECK(where(changed(good, "0.625]", "-1]")) == "nodes[1].reflection[1]");
    CHECK(where(changed(good, "[-0.5]", "[]")) == "nodes[0].reflection");
    CHECK(where("[]").empty());
    CHECK_FALSE(readTextureJson("{"));
}

TEST_CASE("A mutated texture is refused with a place, or plays within bounds")
{
    Random random(17);
    const std::string bytes = "0123456789-+.eE[]{}\",: \n\t\\nulltrue\x80\xFF";
    int played = 0;
    for (int i = 0; i < 1000; ++i)
    {
        std::string text = textureJson(test::randomTexture(random.next() % 50));
        for (std::uint64_t edits = random.next() % 4 + 1; edits > 0; --edits)
        {
            const std::size_t at = random.next() % text.size();
            if (random.next() % 3 == 0)
                text.erase(at, random.next() % 8 + 1);
            else
                text[at] = bytes[random.next() % bytes.size()];
            if (text.empty())
                text = " ";
        }
        const auto read = readTextureJson(text);
        if (!read)
        {
            CHECK_FALSE(read.error().message.empty());
            continue;
        }
        REQUIRE(validate(*read));
        if (++played % 15 != 0)
            continue;
        TexturePlayer player(std::make_shared<const TextureTable>(*read, 8000.0));
        std::vector<float> out(800);
        player.setSpeed(random.uniform());
        player.process(out);
        for (const float sample : out)
            REQUIRE(std::isfinite(sample));
    }
    CHECK(played > 20);
}
