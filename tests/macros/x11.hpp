// What <X11/Xlib.h> does to the names of others.
#pragma once

#define Bool int
#define Status int
#define True 1
#define False 0
#define None 0L
#define Always 2
#define Success 0
#define Above 0
#define Below 1
#define Complex 0
#define Convex 2
#define Nonconvex 1
#define CoordModeOrigin 0
#define CursorShape 0
#define TileShape 1
#define StippleShape 2
#define ControlMask (1 << 2)
#define DestroyAll 0
#define Expose 12
#define FocusIn 9
#define FocusOut 10
#define GrayScale 1
#define KeyPress 2
#define KeyRelease 3
#define LineSolid 0
#define NoSymbol 0L
#define Opposite 4
#define ParentRelative 1L
#define PseudoColor 3
#define StaticColor 2
#define TrueColor 4
#define TopIf 2
#define BottomIf 3
#define Unsorted 0
#define XYBitmap 0
