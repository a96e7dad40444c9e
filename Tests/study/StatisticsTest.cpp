#include "study/statistics/Agreement.h"
#include "study/statistics/Correlation.h"
#include "study/statistics/Distributions.h"
#include "study/statistics/Proportion.h"
#include "study/statistics/Scaling.h"
#include "study/statistics/TwoSamples.h"
#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

using namespace pacini::study;

// Wanted values are of SciPy 1.16, statsmodels 0.14 and pingouin 0.5.

namespace
{
const std::vector<double> a{3.1, 4.7, 5.2, 2.2, 6.9, 5.5, 4.1, 3.3}, b{5.0, 6.1, 7.7, 4.4, 8.2, 6.6, 5.9};

Approx exactly(double value)
{
    return Approx(value).epsilon(1e-12).margin(1e-14);
}
} // namespace

TEST_CASE("t-tests are those of SciPy")
{
    const TTest pooled = pooledTTest(a, b);
    CHECK(pooled.t == exactly(-2.534646741389406));
    CHECK(pooled.p == exactly(0.024905262383594137));
    CHECK(pooled.degrees == 13.0);
    CHECK(pooled.difference95.low == exactly(-3.512821411516799));
    CHECK(pooled.difference95.high == exactly(-0.28003573134034365));

    const TTest welch = welchTTest(a, b);
    CHECK(welch.t == exactly(-2.5535240995296586));
    CHECK(welch.p == exactly(0.024056072270267615));
    CHECK(welch.degrees == exactly(12.979182741282544));
    CHECK(welch.difference95.low == exactly(-3.5011335836078272));

    const std::vector<double> c{5.0, 6.1, 7.7, 4.4, 8.2, 6.6, 5.9, 3.0};
    const TTest paired = pairedTTest(a, c);
    CHECK(paired.t == exactly(-4.886744296001431));
    CHECK(paired.p == exactly(0.001779849905609702));
    CHECK(paired.difference95.high == exactly(-0.7677204573866582));
    CHECK(equalVarianceP(a, b) == exactly(0.8162004912104045));
    CHECK(hedgesG(a, b) == exactly(-1.2346393562344629));
}

TEST_CASE("Correlations are those of SciPy, also without variance")
{
    const std::vector<double> c{5.0, 6.1, 7.7, 4.4, 8.2, 6.6, 5.9, 3.0};
    const Correlation found = correlationOf(a, c);
    CHECK(found.r == exactly(0.8645683979346371));
    CHECK(found.p == exactly(0.005596421592303392));
    CHECK(found.r95.low == exactly(0.409188833391785));
    CHECK(found.r95.high == exactly(0.9751456156224171));
    CHECK(found.slope == exactly(0.9786137995629096));
    const std::vector<double> same(8, 2.0);
    CHECK(correlationOf(a, same).r == 0.0);
    CHECK(correlationOf(same, a).p == 1.0);
    CHECK(correlationOf(a, a).p == 0.0);
    CHECK(correlationOf({}, {}).r95.high == 1.0);
}

TEST_CASE("t-tests of samples without variance have an end")
{
    const std::vector<double> same{2.0, 2.0, 2.0}, other{3.0, 3.0, 3.0};
    CHECK(pooledTTest(same, same).p == 1.0);
    CHECK(pooledTTest(same, other).p == 0.0);
    CHECK(welchTTest(same, other).p == 0.0);
    CHECK(hedgesG(same, other) == 0.0);
}

TEST_CASE("Mann and Whitney's test is SciPy's, exact and with ties")
{
    const MannWhitney exact = mannWhitney(a, b);
    CHECK(exact.exact);
    CHECK(exact.u == 10.0);
    CHECK(exact.p == exactly(0.04009324009324009));
    const MannWhitney ties =
        mannWhitney(std::vector<double>{1, 2, 2, 3, 5, 5, 7, 8}, std::vector<double>{2, 4, 5, 5, 6, 8, 9, 9, 9});
    CHECK_FALSE(ties.exact);
    CHECK(ties.u == 18.5);
    CHECK(ties.p == exactly(0.09788201500770835));
    CHECK(mannWhitney(std::vector<double>{1, 1}, std::vector<double>{1, 1}).p == 1.0);
}

TEST_CASE("Wilcoxon's test is SciPy's, exact with and without ties, and of many pairs")
{
    const std::vector<double> c{5.0, 6.1, 7.7, 4.4, 8.2, 6.6, 5.9, 3.0};
    const SignedRanks exact = signedRanks(a, c);
    CHECK(exact.w == 1.0);
    CHECK(exact.p == exactly(0.015625));
    // scipy.stats.wilcoxon(..., method=PermutationMethod(n_resamples=inf)); one pair is equal.
    const SignedRanks ties = signedRanks(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
                                         std::vector<double>{2, 2, 5, 3, 7, 8, 6, 10, 12, 9});
    CHECK(ties.n == 9);
    CHECK(ties.w == 7.5);
    CHECK(ties.p == exactly(0.07421875));
    // wilcoxon(..., method="approx", correction=False)
    std::vector<double> x, y;
    for (int i = 0; i < 70; ++i)
    {
        x.push_back((i * 7) % 11);
        y.push_back((i * 5) % 13);
    }
    const SignedRanks many = signedRanks(x, y);
    CHECK_FALSE(many.exact);
    CHECK(many.n == 61);
    CHECK(many.p == exactly(0.12471085775494631));
    CHECK(signedRanks(a, a).p == 1.0);
    CHECK(signedRanks({}, {}).p == 1.0);
}

TEST_CASE("Shares of right answers have an interval of people")
{
    // Roots of (p - x)^2 = q^2 x (1 - x) / n by NumPy, n by the variance of a ratio of sums over people.
    const std::vector<CountedAnswers> unlike{{9, 16}, {16, 16}, {8, 16}, {12, 16}, {15, 16}, {7, 16}};
    CHECK(proportionOf(unlike).share95.low == exactly(0.43161489657170615));
    CHECK(proportionOf(unlike).share95.high == exactly(0.8754530771166713));
    const std::vector<CountedAnswers> uneven{{10, 20}, {30, 31}, {4, 8}};
    CHECK(proportionOf(uneven).share95.low == exactly(0.13575778140737593));
    CHECK(proportionOf(uneven).share95.high == exactly(0.9820712741195902));
    // Of one person statsmodels' Wilson interval.
    const std::vector<CountedAnswers> one{{12, 16}};
    CHECK(proportionOf(one).share95.low == exactly(0.5050168346449122));
    CHECK(proportionOf(one).share95.high == exactly(0.8981793250878696));
    CHECK(proportionOf(std::vector<CountedAnswers>{{16, 16}, {16, 16}}).share95.high == 1.0);
    CHECK(proportionOf({}).all == 0);

    // Twelve people with sixteen answers each, of whom some hear it and some do not: the interval contains the share
    // of all people about as often as it says. All answers in one, as if 192 people had answered once, it would not.
    pacini::Random random(11);
    int found = 0, pooled = 0;
    constexpr int studies = 2000;
    for (int study = 0; study < studies; ++study)
    {
        std::vector<CountedAnswers> people(12);
        CountedAnswers all;
        for (CountedAnswers& person : people)
        {
            const double own = random.uniform(0.5, 0.9);
            for (person.all = 0; person.all < 16; ++person.all)
                person.right += random.uniform(0.0, 1.0) < own ? 1u : 0u;
            all = {all.right + person.right, all.all + person.all};
        }
        const auto holds = [](const Interval& interval)
        {
            return interval.low <= 0.7 && 0.7 <= interval.high;
        };
        found += holds(proportionOf(people).share95) ? 1 : 0;
        pooled += holds(proportionOf(std::span(&all, 1)).share95) ? 1 : 0;
    }
    CHECK(found >= 0.94 * studies);
    CHECK(found <= 0.975 * studies);
    CHECK(pooled < 0.91 * studies);
}

TEST_CASE("Corrections for many tests are those of statsmodels")
{
    const std::vector<double> p{0.01, 0.04, 0.03, 0.005, 0.2};
    const std::vector<double> wanted{0.04, 0.09, 0.09, 0.025, 0.2};
    const std::vector<double> found = holm(p);
    for (std::size_t i = 0; i < p.size(); ++i)
        CHECK(found[i] == exactly(wanted[i]));
    CHECK(bonferroni(p) == std::vector<double>{0.05, 0.2, 0.15, 0.025, 1.0});
}

TEST_CASE("Agreement is that of SciPy and pingouin")
{
    const RatingTable table{{7, 4, 9, 3}, {6, 5, 9, 2}, {8, 5, 10, 4}, {5, 3, 7, 5}, {7, 6, 8, 3}};
    const Friedman order = friedman(table);
    CHECK(order.chiSquared == exactly(13.285714285714281));
    CHECK(order.p == exactly(0.0040577599381637275));
    const Friedman ties = friedman({{7, 4, 7, 3}, {6, 5, 9, 5}, {8, 8, 10, 4}, {5, 3, 7, 5}, {7, 6, 8, 3}});
    CHECK(ties.chiSquared == exactly(12.456521739130427));
    CHECK(ties.kendallsW == exactly(0.8304347826086951));
    const IntraclassCorrelation icc = intraclassCorrelation(table);
    CHECK(icc.single == Approx(0.793377).margin(5e-7));
    CHECK(icc.mean == Approx(0.950492).margin(5e-7));
    CHECK(icc.single95.low == Approx(0.44).margin(0.005));
    CHECK(icc.single95.high == Approx(0.98).margin(0.005));
    CHECK(intraclassCorrelation({{1, 1}, {1, 1}}).single == 0.0);
}

TEST_CASE("Cohen's kappa is that of Fleiss, Levin and Paik")
{
    // Statistical Methods for Rates and Proportions, 3rd edition (2003), table 18.1; numbers by NumPy.
    std::vector<std::pair<std::size_t, std::size_t>> codes;
    const std::array<std::array<int, 3>, 3> table{{{75, 1, 4}, {5, 4, 1}, {0, 0, 10}}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            codes.insert(codes.end(), static_cast<std::size_t>(table[i][j]), {i, j});
    const CohensKappa found = cohensKappa(codes);
    CHECK(found.agreement == exactly(0.89));
    CHECK(found.kappa == exactly(0.676470588235294));
    CHECK(found.kappa95.low == Approx(0.5045759580860855).epsilon(1e-9));
    CHECK(found.kappa95.high == Approx(0.8483652183845026).epsilon(1e-9));
    CHECK(cohensKappa({{0, 0}, {1, 1}, {0, 0}}).kappa == exactly(1.0));
    CHECK(cohensKappa({{0, 1}, {1, 0}}).kappa == exactly(-1.0));
    CHECK(cohensKappa({{2, 2}, {2, 2}}).kappa == 0.0); // one category alone tells nothing
    CHECK(cohensKappa({}).agreement == 0.0);
}

TEST_CASE("Distributions are those of SciPy")
{
    CHECK(upperTailChiSquared(7.3, 4.0) == exactly(0.12085874882121235));
    CHECK(normalQuantile(0.9) == exactly(1.2815515655446004));
    CHECK(powerOfT(quantileT(0.975, 20.0), 20.0, 1.0 / 1.2 * std::sqrt(5.5)) ==
          Approx(0.46037556427475174).epsilon(1e-8));
    CHECK(twoTailedT(NAN, 3.0) == 1.0);
    CHECK(twoTailedT(INFINITY, 3.0) == 0.0);
}

TEST_CASE("A box has the quartiles of NumPy, and its whiskers end within one and a half of it")
{
    const SampleSummary box = summaryOf(a);
    CHECK(box.lowerQuartile == exactly(3.25));
    CHECK(box.median == exactly(4.4));
    CHECK(box.upperQuartile == exactly(5.275));
    CHECK(box.outliers.empty());
    const SampleSummary odd = summaryOf(std::vector<double>{1, 2, 3, 4, 5, 100});
    CHECK(odd.outliers == std::vector<double>{100.0});
    CHECK(odd.whiskers.high == 5.0);
    CHECK(summaryOf({}).count == 0);
    CHECK(summaryOf(std::vector<double>{3.0}).sd == 0.0);
}

TEST_CASE("A map gives back the distances that it was made of")
{
    pacini::Random random(5);
    std::vector<std::pair<double, double>> places;
    for (int i = 0; i < 9; ++i)
        places.emplace_back(random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.0));
    std::vector<std::vector<double>> table;
    for (const auto& p : places)
    {
        table.emplace_back();
        for (const auto& q : places)
            table.back().push_back(std::hypot(p.first - q.first, p.second - q.second));
    }
    const Scaling scaling = scaleDissimilarities(table);
    CHECK(scaling.stress < 1e-4);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < places.size(); ++k)
            CHECK(std::hypot(scaling.places[i][0] - scaling.places[k][0],
                             scaling.places[i][1] - scaling.places[k][1]) == Approx(table[i][k]).margin(1e-3));
    // The longest axis comes first.
    double first = 0.0, second = 0.0;
    for (const auto& place : scaling.places)
    {
        first += place[0] * place[0];
        second += place[1] * place[1];
    }
    CHECK(first > second);
    CHECK(scaleDissimilarities({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).stress == 0.0);
}
