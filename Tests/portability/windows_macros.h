#pragma once

// Stand-in for <windows.h>: the macros that it defines under names that code may choose, from minwindef.h, windef.h,
// winnt.h, wingdi.h, rpcndr.h, combaseapi.h and dlgs.h of the Windows SDK, and those of its <math.h>.

// What keywords of 16 bits became.
#define near
#define far
#define NEAR near
#define FAR far
#define pascal __stdcall
#define cdecl __cdecl
#define PASCAL __stdcall
#define CDECL __cdecl
#define CALLBACK __stdcall
#define CONST const
#define VOID void

// Annotations of parameters.
#define IN
#define OUT
#define OPTIONAL

// Types and values.
#define TRUE 1
#define FALSE 0
#define small char
#define hyper __int64
#define interface struct
#define DELETE (0x00010000L)
#define SYNCHRONIZE (0x00100000L)
#define INFINITE 0xFFFFFFFF
#define IGNORE 0
#define STRICT 1
#define NO_ERROR 0L
#define ERROR 0
#define ABSOLUTE 1
#define RELATIVE 2
#define TRANSPARENT 1
#define OPAQUE 2
#define ALTERNATE 1
#define WINDING 2
#define PASSTHROUGH 19
#define DIFFERENCE 11
#define DOMAIN 1
#define SING 2
#define OVERFLOW 3
#define UNDERFLOW 4
#define TLOSS 5
#define PLOSS 6

// Controls of the dialogs that come with Windows.
#define ctl1 0x00A0
#define psh1 0x0400
#define chx1 0x0410
#define rad1 0x0420
#define grp1 0x0430
#define frm1 0x0434
#define rct1 0x0438
#define ico1 0x043c
#define stc1 0x0440
#define lst1 0x0460
#define cmb1 0x0470
#define edt1 0x0480
#define scr1 0x0490

// Unless NOMINMAX is defined.
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
