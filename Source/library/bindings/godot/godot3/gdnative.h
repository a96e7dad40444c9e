/* As much of the binary interface of GDNative 1.0 (Godot 3, 64-bit) as Pacini uses, in declarations of its own: values
 * that are only handed on, and the places of functions in the table that Godot gives to a library. The table only grows
 * at its end, so that these places are those of every Godot 3.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PACINI_GDNATIVE_H
#define PACINI_GDNATIVE_H

#include <stdint.h>

typedef struct godot_variant
{
    uint64_t hidden[3];
} godot_variant;

/* Strings and arrays are one pointer each. */
typedef struct godot_pointer
{
    void* hidden;
} godot_pointer;

typedef void (*godot_function)(void);

typedef struct godot_api
{
    unsigned int type, major, minor;
    const void* next;
    unsigned int extension_count;
    const void* extensions;
    godot_function functions[744];
} godot_api;

typedef struct godot_init_options
{
    uint8_t in_editor;
    uint64_t api_hashes[3];
    godot_function report_version_mismatch, report_loading_error;
    void* library;
    const godot_api* api;
    const void* path;
} godot_init_options;

enum
{
    GODOT_NIL = 0,

    GODOT_POOL_BYTE_ARRAY_READ = 165,
    GODOT_POOL_BYTE_ARRAY_SIZE = 169,
    GODOT_POOL_BYTE_ARRAY_DESTROY = 170,
    GODOT_POOL_REAL_ARRAY_NEW = 187,
    GODOT_POOL_REAL_ARRAY_RESIZE = 196,
    GODOT_POOL_REAL_ARRAY_WRITE = 198,
    GODOT_POOL_REAL_ARRAY_DESTROY = 202,
    GODOT_POOL_VECTOR2_ARRAY_NEW = 219,
    GODOT_POOL_VECTOR2_ARRAY_RESIZE = 228,
    GODOT_POOL_VECTOR2_ARRAY_WRITE = 230,
    GODOT_POOL_VECTOR2_ARRAY_DESTROY = 234,
    GODOT_POOL_BYTE_ARRAY_READ_PTR = 268,
    GODOT_POOL_BYTE_ARRAY_READ_DESTROY = 270,
    GODOT_POOL_REAL_ARRAY_WRITE_PTR = 304,
    GODOT_POOL_REAL_ARRAY_WRITE_DESTROY = 306,
    GODOT_POOL_VECTOR2_ARRAY_WRITE_PTR = 312,
    GODOT_POOL_VECTOR2_ARRAY_WRITE_DESTROY = 314,
    GODOT_ARRAY_GET = 333,
    GODOT_ARRAY_SIZE = 356,
    GODOT_VARIANT_GET_TYPE = 507,
    GODOT_VARIANT_NEW_NIL = 509,
    GODOT_VARIANT_NEW_INT = 512,
    GODOT_VARIANT_NEW_REAL = 513,
    GODOT_VARIANT_NEW_STRING = 514,
    GODOT_VARIANT_NEW_POOL_REAL_ARRAY = 532,
    GODOT_VARIANT_NEW_POOL_VECTOR2_ARRAY = 534,
    GODOT_VARIANT_AS_INT = 539,
    GODOT_VARIANT_AS_REAL = 540,
    GODOT_VARIANT_AS_STRING = 541,
    GODOT_VARIANT_AS_POOL_BYTE_ARRAY = 557,
    GODOT_VARIANT_DESTROY = 570,
    GODOT_CHAR_STRING_GET_DATA = 572,
    GODOT_CHAR_STRING_DESTROY = 573,
    GODOT_STRING_UTF8 = 678,
    GODOT_STRING_CHARS_TO_UTF8 = 681,
    GODOT_STRING_DESTROY = 721
};

#endif
