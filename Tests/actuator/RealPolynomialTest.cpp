#include "support/Catch.h"

#include <pacini/actuator/RealPolynomial.h>

#include <complex>
#include <cstddef>

using namespace pacini;

namespace
{

RealPolynomial polynomialOf(std::initializer_list<double> coefficients)
{
    RealPolynomial p;
    std::size_t i = 0;
    for (const double c : coefficients)
        p.c[i++] = c;
    return p;
}

} // namespace

TEST_CASE("Polynomials have the degree of their highest coefficient that is not 0", "[actuator]")
{
    CHECK(RealPolynomial{}.degree() == 0);
    CHECK(polynomialOf({3.0}).degree() == 0);
    CHECK(polynomialOf({0.0, 2.0}).degree() == 1);
    CHECK(polynomialOf({1.0, 2.0, 0.0, -1e-300}).degree() == 3);
    CHECK(polynomialOf({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}).degree() == 6);
    CHECK(RealPolynomial::identity().degree() == 1);
    CHECK(RealPolynomial::identity().c == polynomialOf({0.0, 1.0}).c);
}

TEST_CASE("Sums, products, derivatives and values of polynomials are those of algebra", "[actuator]")
{
    const RealPolynomial p = polynomialOf({1.0, -2.0, 3.0, 0.5});
    const RealPolynomial q = polynomialOf({4.0, 5.0, -6.0, 7.0});
    CHECK((p + q).c == polynomialOf({5.0, 3.0, -3.0, 7.5}).c);
    CHECK((p + 10.0).c == polynomialOf({11.0, -2.0, 3.0, 0.5}).c);
    CHECK((2.0 * p).c == polynomialOf({2.0, -4.0, 6.0, 1.0}).c);
    CHECK((p * q).c == polynomialOf({4.0, -3.0, -4.0, 36.0, -29.5, 18.0, 3.5}).c);
    CHECK(polynomialOf({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}).derivative().c ==
          polynomialOf({2.0, 6.0, 12.0, 20.0, 30.0, 42.0}).c);
    const RealPolynomial all = polynomialOf({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0});
    CHECK(all.at(2.0) == 1.0 + 4.0 + 12.0 + 32.0 + 80.0 + 192.0 + 448.0);
    CHECK(all.at(-1.0) == 4.0);
    CHECK(all.at(0.0) == 1.0);
    const std::complex<double> i{0.0, 1.0};
    CHECK(all.at(i) == std::complex<double>(1.0 - 3.0 + 5.0 - 7.0, 2.0 - 4.0 + 6.0));
}
