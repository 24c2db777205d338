#include "tools/fit_ltc/shape.h"

#include <cmath>

namespace antumbra::fit {

using glm::dvec2;
using glm::dvec4;

// M^-1 times width_y has the rows width_y (x / width_x - lean z), y and width_y z, of the axes x, y, z that R turns to.
dvec4 storedOf(const Shape& shape, double angle, bool isIsotropic)
{
    const double widthX = std::exp(shape[0]);
    if (isIsotropic)
        return {1, 0, 0, widthX};
    const double widthY = std::exp(shape[1]), turned = angle + shape[3] * widthX;
    const dvec2 x(std::cos(turned), -std::sin(turned)), z(std::sin(turned), std::cos(turned));
    const dvec2 first = widthY * (x / widthX - shape[2] * z), last = widthY * z;
    return {first.x, last.x, first.y, last.y};
}

Shape shapeOf(const dvec4& stored, double angle)
{
    const dvec2 first(stored.x, stored.z), last(stored.y, stored.w);
    const double widthY = glm::length(last);
    const dvec2 z = last / widthY, x(z.y, -z.x);
    const double widthX = widthY / glm::dot(first, x);
    return {std::log(widthX), std::log(widthY), -glm::dot(first, z) / widthY, (std::atan2(z.x, z.y) - angle) / widthX};
}

} // namespace antumbra::fit
