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
    CHECK(WordCategories::ofCsv("sep=;\ncategory;word\na;b\n")->names() == std::vector<std::string>{"a"});
    CHECK(WordCategories::ofCsv("a,b\rc,d\r")->names() == std::vector<std::string>{"a", "c"}); // an old Macintosh
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

TEST_CASE("Tables of ratings of other programs are read as they are")
{
    const auto valuesOf = [](std::string_view text)
    {
        std::vector<double> values;
        const auto read = ratingsOfCsv(text);
        INFO((read.ok() ? "" : read.error().text()));
        REQUIRE(read.ok());
        for (const Rating& rating : *read)
            values.push_back(rating.value);
        return values;
    };
    const std::vector<double> wanted{7.5, -3.0};
    CHECK(valuesOf("\xEF\xBB\xBFstimulus;rating\r\na;7,5\r\nb;-3\r\n") == wanted);
    CHECK(valuesOf("Stimulus\tRating \na, b\t 7,5\nb\t-3.0") == wanted);
    CHECK(valuesOf("stimulus,rating\na,\"7,5\"\nb,+7\nb,-3,\n").size() == 3);
    const auto listener = ratingsOfCsv("\"session_test_id\",\"email\",\"age\",\"session_uuid\",\"trial_id\","
                                       "\"rating_stimulus\",\"rating_score\",\"rating_time\",\"rating_comment\"\n"
                                       "mushra,a@b.c,30,u-1,trial1,C2,80,1234,\n");
    REQUIRE(listener.ok());
    CHECK(listener->front().participant == "u-1");
    CHECK(listener->front().block == "trial1");
    CHECK(listener->front().stimulus == "C2");
    CHECK(listener->front().value == 80.0);
    const auto trial = ratingsOfCsv("rt,stimulus,response,trial_type,trial_index,subject_id\n"
                                    "null,hello.html,null,instructions,0,s7\n812,a.wav,4,audio-slider-response,1,s7\n");
    REQUIRE(trial.ok());
    CHECK(trial->size() == 1);
    CHECK(trial->front().participant == "s7");
    CHECK(trial->front().value == 4.0);
}

TEST_CASE("Missing ratings are counted and told, and columns that may be one or the other are asked for")
{
    std::vector<std::string> warnings;
    const auto read = ratingsOfCsv("stimulus,rating\na,1\nb,\nc,NA\nd,NaN\ne,2\nf\n", {}, &warnings);
    REQUIRE(read.ok());
    CHECK(read->size() == 2);
    CHECK(warnings == std::vector<std::string>{"line 3: has no rating; 4 of 6 lines have none and are left out"});
    CHECK(ratingsOfCsv("stimulus,rating\na,inf\n").error().where == "line 2");
    CHECK(ratingsOfCsv("stimulus,rating\na,7,5\n").error().text() ==
          "line 2: has 3 fields where the first line has 2; put texts and numbers with a separator in quotes");
    CHECK(ratingsOfCsv("stimulus,rating\na,1.2.3\n").error().text() == "line 2: '1.2.3' is not a rating");
    const std::string both = "stimulus,response,score\na,1,2\n";
    CHECK(ratingsOfCsv(both).error().text() == "line 1: has the columns 'response' and 'score', which may both be the "
                                               "rating; name it with --columns rating=NAME");
    RatingColumns columns;
    columns.rating = "Score";
    CHECK(ratingsOfCsv(both, columns)->front().value == 2.0);
    columns.rating = "other";
    CHECK(ratingsOfCsv(both, columns).error().text() == "line 1: has no column 'other'");
    // The rest of a table would else be one field.
    CHECK(ratingsOfCsv("stimulus,rating\na,1\n\"b,2\nc,3\nd,4\n").error().text() ==
          "line 3: has a quotation mark without a second one; close it, or write two of them for one in a text");
    const auto blanks = ratingsOfCsv("participant, stimulus, rating\nP1, a, 1\n P1 ,\ta , 2\nP1, \"a, b\", 3\n");
    REQUIRE(blanks.ok());
    REQUIRE(blanks->size() == 3);
    CHECK((*blanks)[0].stimulus == "a");
    CHECK((*blanks)[1].stimulus == "a");
    CHECK((*blanks)[1].participant == "P1");
    CHECK((*blanks)[2].stimulus == "a, b");
    CHECK(ratingsOfCsv("session_test_id,name,age,trial_id,rating_stimulus,rating_score\nt,Ann,30,1,C1,80\n")
              ->front()
              .participant == "Ann");
    CHECK(ratingsOfCsv(std::string("s\0t\0", 4)).error().text() ==
          "line 1, column 1: is UTF-16 text; save it as UTF-8");
}
