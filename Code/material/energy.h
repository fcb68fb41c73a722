// Look-ups in the tables of energy_tables.h, in lanes: what facets send on in one bounce, and what
// light that would go from facet to facet adds to it, as in Cycles 4 (Kulla and Conty 2017, but the
// lobe is scaled).
#pragma once

#include "material/energy_tables.h"
#include "material/ggx.h"

LANES_BEGIN

// Where a number from 0 to 1 lies between the nodes of a table.
struct TableNode {
    Floats first, part;
    TableNode(Floats x, int nodes) {
        const Floats at =
            min(max(x, Floats(0.0f)), Floats(1.0f)) * Floats(static_cast<float>(nodes - 1));
        first = min(floor(at), Floats(static_cast<float>(nodes - 2)));
        part = at - first;
    }
};
inline Floats between(Floats a, Floats b, Floats part) { return a + (b - a) * part; }
inline Floats wordsAt(const std::uint32_t* table, Ints at, std::uint32_t more) {
    return fromBits(elementsAt(table, plus(at, more), (1u << W) - 1));
}
// Of a table with this many columns that begins at word `from`.
inline Floats lookedUp(const std::uint32_t* table, Floats from, const TableNode& row,
                       const TableNode& column, int columns) {
    const Floats index = from + (row.first * Floats(static_cast<float>(columns)) + column.first);
    const Ints at = wholeOf(Doubles(index));
    const auto n = static_cast<std::uint32_t>(columns);
    const Floats a = between(wordsAt(table, at, 0), wordsAt(table, at, 1), column.part);
    const Floats b = between(wordsAt(table, at, n), wordsAt(table, at, n + 1), column.part);
    return between(a, b, row.part);
}

// The energy of facets seen from one direction; what rough facets need of the tables.
struct FacetEnergy {
    TableNode place, rough;
    FacetEnergy(const Ggx& facets, const Floats3& toEye, Floats roughness)
        : place(facets.tablePlace(toEye), energy::kPlaces), rough(roughness, energy::kRoughs) {}

    Floats all() const { return of(energy::facetTables().all); }
    Floats rise() const { return of(energy::facetTables().rise); }
    Floats bend() const { return of(energy::facetTables().bend); }
    Floats mean() const {
        const std::uint32_t* const table = energy::facetTables().mean;
        const Ints at = wholeOf(Doubles(rough.first));
        return between(wordsAt(table, at, 0), wordsAt(table, at, 1), rough.part);
    }
    // The factor of facets with this mean reflectance: 1 + Fms (1 - E) / E.
    Floats3 scale(const Floats3& meanReflected) const {
        const Floats one(1.0f), e = all(), average = mean();
        const Floats missing = (one - e) / e;
        const auto channel = [&](Floats f) {
            return one + f * average / (one - f * (one - average)) * missing;
        };
        return {channel(meanReflected.x), channel(meanReflected.y), channel(meanReflected.z)};
    }

private:
    Floats of(const std::uint32_t* table) const {
        return lookedUp(table, Floats(0.0f), place, rough, energy::kRoughs);
    }
};

// Dielectric boundaries with this eta, between the slices of its table.
struct BoundarySlices {
    Floats first, part;
    explicit BoundarySlices(Floats eta) {
        const Floats one(1.0f), w = (one - eta) / (one + eta), zero(0.0f);
        const TableNode node(sqrt(sqrt(abs(w))), energy::kSlices);
        const Floats side(static_cast<float>(energy::kSlices));
        first = node.first + select(w < zero, side, zero), part = node.part;
    }
    // Fresnel's part over the hemisphere, weighted by the cosine.
    Floats mean() const {
        const std::uint32_t* const table = energy::sliceMeans();
        const Ints at = wholeOf(Doubles(first));
        return between(wordsAt(table, at, 0), wordsAt(table, at, 1), part);
    }
};
// Facets that are such boundaries.
class BoundaryEnergy {
public:
    BoundaryEnergy(const Ggx& facets, Floats eta)
        : slices_(eta), rough_(facets.lossyRoughness(), energy::kSliceRoughs) {}

    // What they reflect and transmit, seen from a direction.
    Floats all(const Ggx& facets, const Floats3& toEye) const {
        return of(energy::kSentOn, facets.glassPlace(toEye));
    }
    // The mean reflectance of those that reflect.
    Floats reflected(Floats cosEye) const {
        return of(energy::kReflected, sqrt(max(cosEye, Floats(0.0f))));
    }

private:
    Floats of(const energy::SliceTable& table, Floats row) const {
        alignas(64) float first[W], column[W];
        slices_.first.store(first), rough_.first.store(column);
        for (int i = 0; i < W; ++i) {
            if (i > 0 && first[i] == first[i - 1] && column[i] == column[i - 1]) continue;
            for (int k = 0; k < 4; ++k)
                table.need(static_cast<int>(first[i]) + (k & 1),
                           static_cast<int>(column[i]) + (k >> 1));
        }
        const Floats slice(static_cast<float>(table.sliceWords())), from = slices_.first * slice;
        const TableNode place(row, table.rows);
        const auto in = [&](Floats at) {
            return lookedUp(table.words, at, rough_, place, table.rows);
        };
        return between(in(from), in(from + slice), slices_.part);
    }

    BoundarySlices slices_;
    TableNode rough_;
};

LANES_END
