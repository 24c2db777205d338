// Real spherical harmonics written out as polynomials of a unit vector's x, y, z, for numbers and for lanes of numbers.
#pragma once

#include <cstdint>

namespace antumbra::bake {

/// Y_i(x, y, z) of the first kBands bands (2..5) into basis[kBands * kBands]; the order is that of ShFunction. Real is what Number is
/// multiplied by.
template <uint32_t kBands, class Real, class Number>
void evaluateShPolynomials(const Number& x, const Number& y, const Number& z, Number* basis)
{
    static_assert(kBands >= 2 && kBands <= 5);
    const Number xx = x * x, yy = y * y, zz = z * z;
    basis[0] = Number{} + Real(0.28209479177387814);
    basis[1] = Real(0.4886025119029199) * y;
    basis[2] = Real(0.4886025119029199) * z;
    basis[3] = Real(0.4886025119029199) * x;
    if constexpr (kBands > 2) {
        basis[4] = Real(1.0925484305920792) * x * y;
        basis[5] = Real(1.0925484305920792) * y * z;
        basis[6] = Real(0.31539156525252005) * (Real(3) * zz - Real(1));
        basis[7] = Real(1.0925484305920792) * x * z;
        basis[8] = Real(0.5462742152960396) * (xx - yy);
    }
    if constexpr (kBands > 3) {
        basis[9] = Real(0.5900435899266435) * y * (Real(3) * xx - yy);
        basis[10] = Real(2.890611442640554) * x * y * z;
        basis[11] = Real(0.4570457994644658) * y * (Real(5) * zz - Real(1));
        basis[12] = Real(0.3731763325901154) * z * (Real(5) * zz - Real(3));
        basis[13] = Real(0.4570457994644658) * x * (Real(5) * zz - Real(1));
        basis[14] = Real(1.445305721320277) * z * (xx - yy);
        basis[15] = Real(0.5900435899266435) * x * (xx - Real(3) * yy);
        if constexpr (kBands > 4) {
            basis[16] = Real(2.5033429417967046) * x * y * (xx - yy);
            basis[17] = Real(1.7701307697799304) * y * z * (Real(3) * xx - yy);
            basis[18] = Real(0.9461746957575601) * x * y * (Real(7) * zz - Real(1));
            basis[19] = Real(0.6690465435572892) * y * z * (Real(7) * zz - Real(3));
            basis[20] = Real(0.10578554691520431) * (Real(35) * zz * zz - Real(30) * zz + Real(3));
            basis[21] = Real(0.6690465435572892) * x * z * (Real(7) * zz - Real(3));
            basis[22] = Real(0.47308734787878004) * (xx - yy) * (Real(7) * zz - Real(1));
            basis[23] = Real(1.7701307697799304) * x * z * (xx - Real(3) * yy);
            basis[24] = Real(0.6258357354491761) * (xx * (xx - Real(3) * yy) - yy * (Real(3) * xx - yy));
        }
    }
}

} // namespace antumbra::bake
