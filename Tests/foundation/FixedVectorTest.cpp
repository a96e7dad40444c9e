#include "support/Catch.h"

#include <pacini/foundation/FixedVector.h>

#include <numeric>
#include <string>
#include <utility>

using namespace pacini;

TEST_CASE("A fixed vector holds its elements in order, up to its capacity", "[foundation]")
{
    FixedVector<int, 4> v;
    CHECK(v.empty());
    CHECK(v.size() == 0);
    CHECK(FixedVector<int, 4>::capacity() == 4);
    CHECK(v.begin() == v.end());
    for (const int x : {5, 6, 7})
        v.pushBack(x);
    CHECK_FALSE(v.empty());
    CHECK(v.size() == 3);
    CHECK(v[0] == 5);
    CHECK(v[2] == 7);
    CHECK(v.front() == 5);
    CHECK(v.back() == 7);
    v.pushBack(8);
    CHECK(v.size() == 4);
    CHECK(v.back() == 8);
    CHECK(std::as_const(v)[3] == 8);
    CHECK(std::accumulate(v.begin(), v.end(), 0) == 26);
    CHECK(std::as_const(v).end() - std::as_const(v).begin() == 4);
    v[1] = 60;
    v.popFront();
    CHECK(v == FixedVector<int, 4>{60, 7, 8});
    v.popFront();
    CHECK(v == FixedVector<int, 4>{7, 8});
    v.clear();
    CHECK(v.empty());
    v.pushBack(1);
    v.popFront();
    CHECK(v.empty());
}

TEST_CASE("Fixed vectors are equal when they have the same elements, whatever lies behind them", "[foundation]")
{
    FixedVector<std::string, 3> a{"x", "y", "z"};
    a.popFront();
    CHECK(a == FixedVector<std::string, 3>{"y", "z"});
    CHECK(a != FixedVector<std::string, 3>{"y"});
    CHECK(a != FixedVector<std::string, 3>{"y", "z", "z"});
    CHECK(a != FixedVector<std::string, 3>{"y", "x"});
    CHECK(FixedVector<int, 2>{} == FixedVector<int, 2>{});
}

#ifdef NDEBUG
TEST_CASE("What does not fit into a fixed vector is dropped", "[foundation]")
{
    struct
    {
        FixedVector<int, 2> v{1, 2};
        int behind = 77;
    } room;
    room.v.pushBack(3);
    CHECK(room.v.size() == 2);
    CHECK(room.v == FixedVector<int, 2>{1, 2});
    CHECK(room.behind == 77);
}
#endif
