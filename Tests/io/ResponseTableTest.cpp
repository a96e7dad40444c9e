#include "io/ResponseTable.h"

#include "support/Catch.h"
#include "support/Refused.h"

#include <pacini/foundation/Random.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace pacini;

namespace
{
std::string numbered(const std::string& format)
{
    std::string text;
    for (int i = 1; i <= 8; ++i)
        text += fmt::format(fmt::runtime(format), 10 * i, -i);
    return text;
}

void checkIsNumbered(const Result<FrequencyResponse>& read)
{
    REQUIRE(read);
    REQUIRE(read->size() == 8);
    for (std::size_t i = 0; i < 8; ++i)
    {
        CHECK(read->frequency[i] == 10.0 * static_cast<double>(i + 1));
        CHECK(read->level[i] == -static_cast<double>(i + 1));
    }
}
} // namespace

TEST_CASE("Responses are read as measuring programs write them")
{
    checkIsNumbered(readResponseTable(numbered("{},{}\n")));
    checkIsNumbered(readResponseTable("frequency,dB\r\n" + numbered("{}.0, {}\r\n")));
    checkIsNumbered(readResponseTable("sep=;\nfrequency;dB\n" + numbered("{};{}\n")));
    checkIsNumbered(readResponseTable("frequency,dB\r" + numbered("{}.0, {}\r"))); // an old Macintosh
    checkIsNumbered(readResponseTable("\xEF\xBB\xBF\"frequency\";\"raw\"\n" + numbered("{},0;{},00\n")));
    checkIsNumbered(readResponseTable("* Freq(Hz) SPL(dB) Phase(degrees)\n" + numbered("{}  {} 12.5\n")));
    checkIsNumbered(readResponseTable("# made by hand\n\n" + numbered("{}\t{}\t1e3\n") + "// the end"));
    checkIsNumbered(readResponseTable("Hz,dB,error\n" + numbered("+{},{},,\n")));
}

TEST_CASE("A wrong line of a response is named with what is wrong in it")
{
    const auto where = [](const std::string& text)
    {
        return test::refusedAt(readResponseTable(text));
    };
    CHECK(where("") == "points");
    CHECK(where("f,dB\n10,0\n20,0\n") == "points");
    CHECK(where("f,dB\n" + numbered("{},{}\n") + "ninety,0\n") == "line 10: frequency");
    CHECK(where("f,dB\nwhat,now\n" + numbered("{},{}\n")) == "line 2: frequency");
    CHECK(where(numbered("{},{}\n") + "90,\n") == "line 9: level");
    CHECK(where(numbered("{},{}\n") + "90\n") == "line 9: level");
    CHECK(where(numbered("{},{}\n") + "80,0\n") == "line 9: frequency");
    CHECK(where("# c\n" + numbered("{},{}\n") + "70,0\n") == "line 10: frequency");
    CHECK(where(numbered("{},{}\n") + "nan,0\n") == "line 9: frequency");
    CHECK(where(numbered("{},{}\n") + "90,inf\n") == "line 9: level");
    CHECK(where(numbered("{},{}\n") + "90,1e300\n") == "line 9: level");
    CHECK(where("-1,0\n" + numbered("{},{}\n")) == "line 1: frequency");
    CHECK(where(numbered("5,{}\n")) == "line 2: frequency");
    CHECK(where("RIFF\x01\x02\xff\xfe\nWAVE\n") == "line 2: frequency");
}

TEST_CASE("A table that was written is read back exactly")
{
    Random random(5);
    FrequencyResponse response;
    double frequency = 1.0;
    for (int i = 0; i < 500; ++i)
    {
        frequency *= 1.0 + random.uniform(1e-6, 0.02);
        response.frequency.push_back(frequency);
        response.level.push_back(random.uniform(-200.0, 200.0));
    }
    const std::vector<TableColumn> columns{
        {"frequency", response.frequency}, {"dB", response.level}, {"noise", std::vector<double>(500, std::nan(""))}};
    const auto text = tableText(columns);
    CHECK(text.starts_with("frequency,dB,noise\n"));
    const auto read = readResponseTable(text);
    REQUIRE(read);
    CHECK(*read == response);
}
