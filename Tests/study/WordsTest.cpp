#include "study/Words.h"

#include "study/Ratings.h"
#include "support/Catch.h"

#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::study;

TEST_CASE("Words are taken out of what people write, in German and English")
{
    CHECK(wordsOf("Ein RAUES, tiefes Grollen... und sehr KÖRNIG!") ==
          std::vector<std::string>{"raues", "tiefes", "grollen", "körnig"});
    CHECK(wordsOf("It is like a ping-pong ball \xE2\x80\x93 twice (2x)") ==
          std::vector<std::string>{"ping-pong", "ball", "twice", "x"});
    CHECK(wordsOf("").empty());
    CHECK(wordsOf("und, der - die").empty());
    CHECK_FALSE(wordsOf("\xFF\xFE half \xC3").empty());
}

TEST_CASE("Categories come from a table, the longest beginning first")
{
    const auto table = WordCategories::ofCsv("category,word\nspectral,rau*\nintensity,stark\norigin,rausch*\n");
    REQUIRE(table);
    CHECK(table->names() == std::vector<std::string>{"spectral", "intensity", "origin"});
    CHECK(table->categoryOf("rau") == "spectral");
    CHECK(table->categoryOf("rauschen") == "origin");
    CHECK(table->categoryOf("stark") == "intensity");
    CHECK(table->categoryOf("starker").empty());
    CHECK(WordCategories::ofCsv("a,b\nnothing\n").error().where == "line 2");
    CHECK_FALSE(WordCategories::ofCsv(""));
}

TEST_CASE("Words are counted by group")
{
    const std::vector<Description> given{
        {"A", "1", "x", "rough, rough and deep"}, {"A", "2", "x", "Deep; rough"}, {"B", "3", "x", "soft"}};
    const WordCounts counts = countWords(given, "A");
    REQUIRE(counts.size() == 2);
    CHECK(counts[0] == std::pair<std::string, std::size_t>("rough", 3));
    CHECK(counts[1].second == 2);
}

TEST_CASE("Ratings come back from their table, and bad lines are named")
{
    const std::vector<Rating> ratings{{"A", "1", "", "x, y", 3.5}, {"B", "2", "block \"two\"", "z", -1.0}};
    const auto read = ratingsOfCsv(ratingsCsv(ratings));
    REQUIRE(read);
    REQUIRE(read->size() == 2);
    CHECK((*read)[0].stimulus == "x, y");
    CHECK((*read)[1].block == "block \"two\"");
    CHECK((*read)[1].value == -1.0);
    CHECK(ratingsOfCsv("stimulus;rating\r\na;1\r\n").value().size() == 1);
    CHECK(ratingsOfCsv("stimulus,rating\na,1\nb,x\n").error().where == "line 3");
    CHECK(ratingsOfCsv("stimulus,rating\na,nan\n").error().where == "line 2");
    CHECK(ratingsOfCsv("stimulus\na\n").error().where == "line 1");
    CHECK_FALSE(ratingsOfCsv("stimulus,rating\n"));
    CHECK_FALSE(ratingsOfCsv(""));
}
