// After section 4 of the paper (bake/ltc.h), and in three things otherwise:
// - What is minimised is the sum of the relative L1 and L2 distances, not L3: L1 bounds the error under any light, L2 keeps the highlight,
//   and both are what a report measures.
// - The lobe's angle is free: the best cosine's axis is not always the lobe's mean direction.
// - Nodes are fitted again for the error of what is interpolated between them, each with its neighbours held: for its square, so that a
//   node does not pay with a great error of its own where lobes are thinner than the table's steps.
#include "tools/fit_ltc/fit.h"

#include "base/check.h"
#include "tools/fit_ltc/lobe.h"
#include "tools/fit_ltc/rounds.h"
#include "tools/fit_ltc/shape.h"
#include "tools/fit_ltc/simplex.h"

#include <array>
#include <cmath>
#include <limits>

namespace antumbra::fit {

namespace {

using bake::Ltc;
using bake::LtcTables;
using glm::dvec4;

// Points of the unit square, squared: of a node's integrals, of its distance, and of each of nine distances about it.
constexpr uint32_t kNormSide = 256, kNodeSide = 32, kAboutSide = 20;
constexpr int kPolishes = 2;
constexpr double kWorkOfPolish = 0.7; // that of a node's first two fits being one

struct Search
{
    double step, tolerance;
    int mostSteps;
};
constexpr Search kFirstSearch{0.1, 1e-6, 300};
constexpr Search kPolishSearch{0.02, 1e-5, 80};

double costOf(const Distance& distance) { return distance.l1 + distance.l2; }

class TableFit
{
public:
    explicit TableFit(uint32_t size) : angles_(size_t{size} * size), costs_(angles_.size(), std::numeric_limits<double>::infinity())
    {
        tables_.size = size;
        tables_.matrix.resize(angles_.size());
        tables_.amplitude.resize(angles_.size());
    }

    [[nodiscard]] const LtcTables& tables() const { return tables_; }

    /// All views at one roughness: down from the normal, each from the one before, and up again.
    void fitColumn(uint32_t column);
    /// Needs all columns, and changes one node.
    void polish(uint32_t column, uint32_t row);

private:
    struct About; // a place whose look-up a node has a share in

    [[nodiscard]] size_t indexOf(uint32_t column, uint32_t row) const { return size_t{row} * tables_.size + column; }
    void integrate(uint32_t column, uint32_t row);
    void improve(uint32_t column, uint32_t row, const Shape& start);
    [[nodiscard]] Shape shapeAt(uint32_t column, uint32_t row) const;
    [[nodiscard]] std::vector<About> placesAbout(uint32_t column, uint32_t row) const;

    LtcTables tables_;
    std::vector<double> angles_; // of the lobes' mean directions
    std::vector<double> costs_;  // of nodes, by the first fit
    Pattern normPattern_ = gridPattern(kNormSide), nodePattern_ = gridPattern(kNodeSide), aboutPattern_ = gridPattern(kAboutSide);
};

void TableFit::integrate(uint32_t column, uint32_t row)
{
    const LobeNorms norms = normsOf(bake::cosViewOfRow(row, tables_.size), bake::alphaOfColumn(column, tables_.size), normPattern_);
    tables_.amplitude[indexOf(column, row)] = {norms.magnitude, norms.fresnel, 0, 0};
    angles_[indexOf(column, row)] = std::atan2(norms.mean.x, norms.mean.z);
}

Shape TableFit::shapeAt(uint32_t column, uint32_t row) const
{
    return shapeOf(tables_.matrix[indexOf(column, row)], angles_[indexOf(column, row)]);
}

void TableFit::improve(uint32_t column, uint32_t row, const Shape& start)
{
    const size_t index = indexOf(column, row);
    const Lobe lobe(bake::cosViewOfRow(row, tables_.size), bake::alphaOfColumn(column, tables_.size), nodePattern_);
    const auto cost = [&](const Shape& shape) {
        return costOf(lobe.distanceTo(Ltc(storedOf(shape, angles_[index], row == 0)), tables_.amplitude[index].x));
    };
    Shape from = start;
    // Once more from where it ended: a simplex that collapsed early opens again.
    for (int round = 0; round < 2; ++round) {
        Simplex<4> simplex(cost, from, freedomOf(row == 0), kFirstSearch.step);
        simplex.shrink(cost, kFirstSearch.tolerance, kFirstSearch.mostSteps);
        from = simplex.best().at;
        if (simplex.best().value < costs_[index]) {
            costs_[index] = simplex.best().value;
            tables_.matrix[index] = storedOf(from, angles_[index], row == 0);
        }
    }
}

void TableFit::fitColumn(uint32_t column)
{
    // A narrow lobe about the normal is a cosine as wide as 2 alpha, which GGX resembles to the power of its tail.
    const double width = std::log(2 * bake::alphaOfColumn(column, tables_.size));
    integrate(column, 0);
    improve(column, 0, {width, width, 0, 0});
    for (uint32_t row = 1; row < tables_.size; ++row) {
        integrate(column, row);
        improve(column, row, shapeAt(column, row - 1));
    }
    for (uint32_t row = tables_.size - 1; row-- > 1;)
        improve(column, row, shapeAt(column, row + 1));
}

struct TableFit::About
{
    Lobe lobe;
    double amplitude;
    dvec4 others; // what the other nodes add to the matrix
    double share; // of the node in the look-up
    double weight;
};

// Simpson's rule on each of the cells about the node.
std::vector<TableFit::About> TableFit::placesAbout(uint32_t column, uint32_t row) const
{
    std::vector<About> places;
    const double last = tables_.size - 1;
    for (const double down : {-0.5, 0.0, 0.5})
        for (const double across : {-0.5, 0.0, 0.5}) {
            const double x = column + across, y = row + down;
            if (x < 0 || y < 0 || x > last || y > last)
                continue;
            const double share = (1 - std::abs(across)) * (1 - std::abs(down));
            const double roughness = x / last, cosView = 1 - y * y / (last * last);
            const bake::LtcTexel found = bake::lookUp(tables_, roughness, cosView);
            places.push_back({.lobe = Lobe(bake::cosViewOfRow(y, tables_.size), bake::alphaOfColumn(x, tables_.size), aboutPattern_),
                              .amplitude = found.amplitude.x,
                              .others = found.matrix - share * dvec4(tables_.matrix[indexOf(column, row)]),
                              .share = share,
                              .weight = (across == 0 ? 1.0 : 2.0) * (down == 0 ? 1.0 : 2.0)});
        }
    return places;
}

void TableFit::polish(uint32_t column, uint32_t row)
{
    const size_t index = indexOf(column, row);
    const std::vector<About> places = placesAbout(column, row);
    const auto cost = [&](const Shape& shape) {
        const dvec4 stored = storedOf(shape, angles_[index], row == 0);
        double sum = 0;
        for (const About& place : places) {
            const dvec4 mixed = place.others + place.share * stored;
            if (mixed.x * mixed.w - mixed.y * mixed.z <= 0)
                return std::numeric_limits<double>::infinity();
            const double there = costOf(place.lobe.distanceTo(Ltc(mixed), place.amplitude));
            sum += place.weight * there * there;
        }
        return sum;
    };
    Simplex<4> simplex(cost, shapeAt(column, row), freedomOf(row == 0), kPolishSearch.step);
    simplex.shrink(cost, kPolishSearch.tolerance, kPolishSearch.mostSteps);
    tables_.matrix[index] = storedOf(simplex.best().at, angles_[index], row == 0);
}

} // namespace

std::optional<LtcTables> fitTables(const FitJob& job)
{
    check(job.size >= 2 && job.threads >= 1, "a table of two nodes or more, and a thread");
    TableFit fit(job.size);
    Rounds rounds(job.threads, 1.0 * job.size * job.size * (1 + kPolishes * kWorkOfPolish), job.report, job.isInterrupted);
    if (!rounds.finish(job.size, job.size, [&](uint32_t column) { fit.fitColumn(column); }))
        return std::nullopt;
    // Nodes of every second column and row share no cell: a quarter of the table at a time.
    for (int round = 0; round < 4 * kPolishes; ++round) {
        const uint32_t firstColumn = round % 2, firstRow = round / 2 % 2;
        const uint32_t columns = (job.size - firstColumn + 1) / 2, rows = (job.size - firstRow + 1) / 2;
        const auto polish = [&](uint32_t unit) { fit.polish(firstColumn + 2 * (unit % columns), firstRow + 2 * (unit / columns)); };
        if (!rounds.finish(columns * rows, kWorkOfPolish, polish))
            return std::nullopt;
    }
    return fit.tables();
}

} // namespace antumbra::fit
