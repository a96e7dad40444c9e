#include "study/statistics/Scaling.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pacini::study
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd distancesOf(const MatrixXd& places)
{
    MatrixXd distances(places.rows(), places.rows());
    for (Index i = 0; i < places.rows(); ++i)
        for (Index k = 0; k < places.rows(); ++k)
            distances(i, k) = (places.row(i) - places.row(k)).norm();
    return distances;
}

/// Axes turned to where the places spread most.
MatrixXd onPrincipalAxes(MatrixXd places)
{
    places.rowwise() -= places.colwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(places.transpose() * places);
    return places * solver.eigenvectors().rowwise().reverse();
}
} // namespace

Scaling scaleDissimilarities(const std::vector<std::vector<double>>& table, std::size_t dimensions)
{
    const auto n = static_cast<Index>(table.size()), d = static_cast<Index>(dimensions);
    MatrixXd wanted(n, n);
    for (Index i = 0; i < n; ++i)
        for (Index k = 0; k < n; ++k)
            wanted(i, k) = table[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];

    const MatrixXd centring = MatrixXd::Identity(n, n) - MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
    const MatrixXd products = -0.5 * centring * wanted.cwiseAbs2() * centring;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(products);
    MatrixXd places = MatrixXd::Zero(n, d);
    for (Index k = 0; k < std::min(d, n); ++k)
        places.col(k) =
            solver.eigenvectors().col(n - 1 - k) * std::sqrt(std::max(0.0, solver.eigenvalues()(n - 1 - k)));

    // Guttman's transform: each step lowers the raw stress.
    constexpr int mostSteps = 1000;
    constexpr double enough = 1e-10;
    double before = -1.0;
    const double scale = wanted.squaredNorm();
    for (int step = 0; step < mostSteps; ++step)
    {
        const MatrixXd distances = distancesOf(places);
        const double stress = scale > 0.0 ? (distances - wanted).squaredNorm() / scale : 0.0;
        if (before >= 0.0 && before - stress < enough)
            break;
        before = stress;
        MatrixXd b = MatrixXd::Zero(n, n);
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < n; ++k)
                if (i != k && distances(i, k) > 0.0)
                    b(i, k) = -wanted(i, k) / distances(i, k);
        for (Index i = 0; i < n; ++i)
            b(i, i) = -b.row(i).sum();
        places = b * places / static_cast<double>(n);
    }
    places = onPrincipalAxes(std::move(places));
    Scaling scaling;
    for (Index i = 0; i < n; ++i)
        scaling.places.emplace_back(places.row(i).begin(), places.row(i).end());
    const MatrixXd distances = distancesOf(places);
    if (distances.squaredNorm() > 0.0)
        scaling.stress = (distances - wanted).norm() / distances.norm();
    return scaling;
}

} // namespace pacini::study
