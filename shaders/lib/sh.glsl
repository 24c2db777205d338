// Real spherical harmonics in the order of golden/README.md (Ramamoorthi and Hanrahan 2001).
#ifndef LIB_SH_GLSL
#define LIB_SH_GLSL

// The first nine: three bands.
void shBasis3(vec3 d, out float y[9])
{
    y[0] = 0.2820947918;
    y[1] = 0.4886025119 * d.y;
    y[2] = 0.4886025119 * d.z;
    y[3] = 0.4886025119 * d.x;
    y[4] = 1.0925484306 * d.x * d.y;
    y[5] = 1.0925484306 * d.y * d.z;
    y[6] = 0.3153915653 * (3.0 * d.z * d.z - 1.0);
    y[7] = 1.0925484306 * d.x * d.z;
    y[8] = 0.5462742153 * (d.x * d.x - d.y * d.y);
}

// The first sixteen: four bands.
void shBasis4(vec3 d, out float y[16])
{
    float three[9];
    shBasis3(d, three);
    for (int i = 0; i < 9; ++i)
        y[i] = three[i];
    float xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    y[9] = 0.5900435899 * d.y * (3.0 * xx - yy);
    y[10] = 2.8906114426 * d.x * d.y * d.z;
    y[11] = 0.4570457995 * d.y * (5.0 * zz - 1.0);
    y[12] = 0.3731763326 * d.z * (5.0 * zz - 3.0);
    y[13] = 0.4570457995 * d.x * (5.0 * zz - 1.0);
    y[14] = 1.4453057213 * d.z * (xx - yy);
    y[15] = 0.5900435899 * d.x * (xx - 3.0 * yy);
}

vec3 evaluateSh3(vec3 coefficients[9], vec3 d)
{
    float y[9];
    shBasis3(d, y);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        sum += coefficients[i] * y[i];
    return sum;
}

// The irradiance of a surface that faces `normal`: convolution with the clamped cosine.
vec3 irradianceOfSh3(vec3 radiance[9], vec3 normal)
{
    vec3 irradiance[9];
    for (int i = 0; i < 9; ++i)
        irradiance[i] = radiance[i] * (i < 1 ? 3.1415926536 : i < 4 ? 2.0943951024 : 0.7853981634);
    return evaluateSh3(irradiance, normal);
}

#endif
