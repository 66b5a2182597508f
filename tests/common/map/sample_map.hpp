#pragma once

#include <string>

namespace rodeira::map {

// Figure 18 of the thesis, completed: the lines that it shows stand as it shows them (the elided numbers of curves 1 and 15
// are ours, and so are the lines behind its "..."), with the first bytes of its picture made a whole PNG of 2 x 1 pixels.
inline const std::string kFigure18Lines =
    "p,1,63.5616,14.70026,2.129805,45.5,14.70026,2.13,30.25,14.70026,2.13,12,14.70026,2\n"
    "p,2,63.5616,14.70026,-1.5,45.5,14.70026,-1.5,30.25,14.70026,-1.5,12,14.70026,-1.5\n"
    "p,3,12,14.70026,2,6,14.70026,2,0,14.70026,2,-6,14.70026,2\n"
    "p,14,7.1,14.70026,-18.65211,3.4,14.70026,-40.25,7.1,14.70026,-60,7.1,14.70026,-80.125\n"
    "p,4,12,14.70026,-1.5,6,14.70026,-1.5,0,14.70026,-1.5,-6,14.70026,-1.5\n"
    "p,15,10.66854,14.70026,-18.65211,6.9,14.70026,-40.25,10.66854,14.70026,-60,10.66854,14.70026,-80.125\n"
    "p,16,12,14.70026,2,8,14.70026,2,7.1,14.70026,-6,7.1,14.70026,-18.65211\n"
    "p,17,12,14.70026,-1.5,11,14.70026,-1.5,10.66854,14.70026,-12,10.66854,14.70026,-18.65211\n"
    "l,1,1,False,1,2,False,4,1\n"
    "l,3,3,False,1,4,False,4,2\n"
    "l,4,16,True,0,17,True,0,0\n"
    "l,8,15,False,1,14,False,1,2\n";

inline const std::string kPng2x1 = std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x08\x02\0\0\0i i\n\n\0i\r\n", 48);

inline std::string Figure18() {
  return kFigure18Lines + "c,1,4,False,0,0,0\nc,2,4,False,0,0,0\nc,6,3,False,0,0,0\ns,10\ni\n" + kPng2x1;
}
// As appendix A.15 writes it: four fields in the lines `c`.
inline std::string AppendixA15() { return kFigure18Lines + "c,1,3,False\nc,1,4,True\ns,10\ni\n" + kPng2x1; }

// A map without anything wrong: two straight lanes of 3 m, one behind the other, and a turn to the left from the first.
inline const std::string kGoodLines =
    "p,1,0,1,1.5,10,1,1.5,20,1,1.5,30,1,1.5\n"
    "p,2,0,1,-1.5,10,1,-1.5,20,1,-1.5,30,1,-1.5\n"
    "p,3,60,1,1.5,50,1,1.5,40,1,1.5,30,1,1.5\n"
    "p,4,30,1,-1.5,40,1,-1.5,50,1,-1.5,60,1,-1.5\n"
    "p,5,30,1,1.5,34,1,1.5,38.5,1,6,38.5,1,10\n"
    "p,6,30,1,-1.5,36,1,-1.5,41.5,1,4,41.5,1,10\n"
    "l,1,1,False,3,2,False,1,1\n"
    "l,2,3,True,3,4,False,1,2\n"
    "l,3,5,False,0,6,False,1,2\n"
    "c,1,2,False,0,0,0\n"
    "c,1,3,True,0,0,0\n";
inline std::string GoodMap() { return kGoodLines + "s,10\ni\n"; }

}  // namespace rodeira::map
