#include "study/statistics/Distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace pacini::study
{

namespace
{
// Never throws: what has no value is NaN, as in <cmath>.
using Policy =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::pole_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::promote_double<false>>;
using StudentsT = boost::math::students_t_distribution<double, Policy>;
using FisherF = boost::math::fisher_f_distribution<double, Policy>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;
using Normal = boost::math::normal_distribution<double, Policy>;
using NonCentralT = boost::math::non_central_t_distribution<double, Policy>;
} // namespace

double twoTailedT(double t, double degrees)
{
    if (std::isnan(t) || !(degrees > 0.0))
        return 1.0;
    if (std::isinf(t))
        return 0.0;
    return 2.0 * boost::math::cdf(boost::math::complement(StudentsT(degrees), std::abs(t)));
}

double upperTailF(double f, double numeratorDegrees, double denominatorDegrees)
{
    if (std::isnan(f))
        return 1.0;
    if (std::isinf(f))
        return 0.0;
    return boost::math::cdf(boost::math::complement(FisherF(numeratorDegrees, denominatorDegrees), f));
}

double lowerTailF(double f, double numeratorDegrees, double denominatorDegrees)
{
    if (std::isnan(f) || std::isinf(f))
        return 1.0;
    return boost::math::cdf(FisherF(numeratorDegrees, denominatorDegrees), f);
}

double upperTailChiSquared(double x, double degrees)
{
    if (std::isnan(x))
        return 1.0;
    if (std::isinf(x))
        return 0.0;
    return boost::math::cdf(boost::math::complement(ChiSquared(degrees), x));
}

double twoTailedNormal(double z)
{
    return std::isnan(z) ? 1.0 : std::erfc(std::abs(z) / std::sqrt(2.0));
}

double normalQuantile(double p)
{
    return boost::math::quantile(Normal(), p);
}

double quantileT(double p, double degrees)
{
    return boost::math::quantile(StudentsT(degrees), p);
}

double quantileF(double p, double numeratorDegrees, double denominatorDegrees)
{
    return boost::math::quantile(FisherF(numeratorDegrees, denominatorDegrees), p);
}

double powerOfT(double critical, double degrees, double noncentrality)
{
    const NonCentralT distribution(degrees, noncentrality);
    return boost::math::cdf(boost::math::complement(distribution, critical)) +
           boost::math::cdf(distribution, -critical);
}

} // namespace pacini::study
