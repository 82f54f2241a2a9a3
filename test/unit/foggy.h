/* foggy.h: a scene with media. Used by: test_gates.c, test_lights.c. */
#ifndef ASBDPT_TEST_FOGGY_H
#define ASBDPT_TEST_FOGGY_H

/* Fog about the lens, a point light and a lamp, in the sky, with a ball of milk in glass: three groups of lights. */
static const char FOGGY[] =
    "Integrator \"bdpt\" MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.01 .02 .03]\n"
    "\"rgb sigma_s\" [.1 .1 .08] \"float g\" .5 MakeNamedMedium \"milk\" \"string type\" \"homogeneous\"\n"
    "\"rgb sigma_a\" [.1 .2 .4] \"rgb sigma_s\" [2 2 2] MediumInterface \"fog\"\n"
    "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera \"perspective\" \"float fov\" 42 PixelFilter \"mitchell\"\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 WorldBegin\n"
    "AttributeBegin MediumInterface \"\" LightSource \"infinite\" \"rgb L\" [.3 .4 .5] AttributeEnd\n"
    "LightSource \"point\" \"rgb I\" [3 2 1] \"point from\" [-1 2 0] \"string group\" \"warm\"\n"
    "AttributeBegin MediumInterface \"fog\" \"\" Material \"\" Shape \"sphere\" \"float radius\" 7 AttributeEnd\n"
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6] Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 4 -2  2 4 -2  2 4 2  -2 4 2]\n"
    "AttributeEnd MediumInterface \"milk\" \"fog\" Material \"glass\"\n"
    "Translate 0 .7 0 Shape \"sphere\" \"float radius\" .6 WorldEnd\n";

#endif
