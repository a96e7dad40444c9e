#pragma once

// Multidimensional scaling of dissimilarities.

#include <cstddef>
#include <vector>

namespace pacini::study
{

/// Places of things in a plane, and how badly their distances fit.
struct Scaling
{
    std::vector<std::vector<double>> places; ///< for each thing its coordinates, the longest axis first
    double stress = 0.0;                     ///< Kruskal's (1964) stress-1: 0 fits, above .2 is poor
};

/// Places `things` of a symmetric table of dissimilarities (0 or more) in `dimensions`: classical scaling (Torgerson
/// 1952) as a start, improved by majorisation (SMACOF, de Leeuw 1977). Two things at least.
[[nodiscard]] Scaling scaleDissimilarities(const std::vector<std::vector<double>>& table, std::size_t dimensions = 2);

} // namespace pacini::study
