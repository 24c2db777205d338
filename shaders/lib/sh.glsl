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

// The first 25: five bands.
void shBasis5(vec3 d, out float y[25])
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
    y[16] = 2.5033429418 * d.x * d.y * (xx - yy);
    y[17] = 1.7701307698 * d.y * d.z * (3.0 * xx - yy);
    y[18] = 0.9461746958 * d.x * d.y * (7.0 * zz - 1.0);
    y[19] = 0.6690465436 * d.y * d.z * (7.0 * zz - 3.0);
    y[20] = 0.1057855469 * (35.0 * zz * zz - 30.0 * zz + 3.0);
    y[21] = 0.6690465436 * d.x * d.z * (7.0 * zz - 3.0);
    y[22] = 0.4730873479 * (xx - yy) * (7.0 * zz - 1.0);
    y[23] = 1.7701307698 * d.x * d.z * (xx - 3.0 * yy);
    y[24] = 0.6258357354 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy));
}

// What the convolution with the clamped cosine multiplies a coefficient by: irradiance of radiance. The fourth band has no part in it.
float cosineLobe(uint i) { return i < 1u ? 3.1415926536 : i < 4u ? 2.0943951024 : i < 9u ? 0.7853981634 : i < 16u ? 0.0 : -0.1308996939; }

// The irradiance of a surface that faces `normal`.
vec3 irradianceOfSh5(vec3 radiance[25], vec3 normal)
{
    float y[25];
    shBasis5(normal, y);
    vec3 irradiance = vec3(0.0);
    for (uint i = 0u; i < 25u; ++i)
        irradiance += cosineLobe(i) * y[i] * radiance[i];
    return irradiance;
}

#endif
