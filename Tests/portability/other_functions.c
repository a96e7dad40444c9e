/* Stands before the C library (LD_PRELOAD): its functions, each 1e-12 of its result too large, ten thousand times what
   libraries differ by. What still has the same bytes does not depend on a library's last bits. Powers with whole
   exponents stay: every library has those of 10 exactly as far as they are used. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>

#define LIBRARY(name, ...)                                                                                             \
    static double (*library)(__VA_ARGS__);                                                                             \
    if (!library)                                                                                                      \
    *(void**)&library = dlsym(RTLD_NEXT, #name)
#define OF_ONE(name)                                                                                                   \
    double name(double x)                                                                                              \
    {                                                                                                                  \
        LIBRARY(name, double);                                                                                         \
        return library(x) * (1 + 1e-12);                                                                               \
    }
#define OF_TWO(name)                                                                                                   \
    double name(double x, double y)                                                                                    \
    {                                                                                                                  \
        LIBRARY(name, double, double);                                                                                 \
        return library(x, y) * (1 + 1e-12);                                                                            \
    }

OF_ONE(sin)
OF_ONE(cos)
OF_ONE(tan)
OF_ONE(asin)
OF_ONE(exp)
OF_ONE(exp2)
OF_ONE(expm1)
OF_ONE(log)
OF_ONE(log2)
OF_ONE(log10)
OF_ONE(log1p)
OF_ONE(tanh)
OF_ONE(cbrt)
OF_TWO(atan2)
OF_TWO(hypot)

double pow(double x, double y)
{
    LIBRARY(pow, double, double);
    return library(x, y) * (y == rint(y) ? 1 : 1 + 1e-12);
}

void sincos(double x, double* sine, double* cosine)
{
    *sine = sin(x);
    *cosine = cos(x);
}
