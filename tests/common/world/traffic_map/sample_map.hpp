// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::traffic_map {

// Figure 18 of the thesis, completed to a whole map: curves 1 and 15, lanes 1 and 8, the connections of lanes 1, 2 and
// 6, the scale and the picture's first bytes are the figure's as far as it prints them; what it leaves out is ours.
// Behind the PNG's header stand bytes that a careless reader takes for lines.
using namespace std::string_literals;
inline const std::string kFigure18Lines =
    "p,1,63.5616,14.70026,2.129805,49,14.70026,2.13,34.5,14.70026,2.13,20,14.70026,2.13\n"
    "p,2,63.5616,14.70026,5.7,49,14.70026,5.7,34.5,14.70026,5.7,20,14.70026,5.7\n"
    "p,3,63.5616,14.70026,5.7,45,14.70026,5.7,38,14.70026,2.13,20,14.70026,2.13\n"
    "p,4,63.5616,14.70026,9.3,45,14.70026,9.3,38,14.70026,5.7,20,14.70026,5.7\n"
    "p,5,10.66854,14.70026,-18.65211,10.66854,14.70026,-4,14,14.70026,2.13,20,14.70026,2.13\n"
    "p,6,7.1,14.70026,-18.65211,7.1,14.70026,-2,12,14.70026,5.7,20,14.70026,5.7\n"
    "p,7,-100,14.70026,50,-83,14.70026,50,-67,14.70026,50,-50,14.70026,50\n"
    "p,8,-100,14.70026,46.5,-83,14.70026,46.5,-67,14.70026,46.5,-50,14.70026,46.5\n"
    "p,9,-50,14.70026,50,-34,14.70026,50,-17,14.70026,50,0,14.70026,50\n"
    "p,10,-50,14.70026,46.5,-34,14.70026,46.5,-17,14.70026,46.5,0,14.70026,46.5\n"
    "p,14,7.1,14.70026,-18.65211,7.1,14.70026,-40.25,7.1,14.70026,-60,7.1,14.70026,-80.125\n"
    "p,15,10.66854,14.70026,-18.65211,10.66854,14.70026,-40.25,10.66854,14.70026,-60,10.66854,14.70026,-80.125\n"
    "l,1,1,False,1,2,False,4,1\n"
    "l,2,3,False,4,4,False,1,1\n"
    "l,3,9,False,1,10,False,1,2\n"
    "l,4,5,True,0,6,True,0,0\n"
    "l,6,7,False,1,8,False,1,1\n"
    "l,8,15,False,1,14,False,1,2\n";

inline const std::string kPng2x1 =
    "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x08\x02\0\0\0i i\n\n\0i\r\n\0\0\0\0IEND\xae\x42\x60\x82"s;

inline std::string Figure18() {
  return kFigure18Lines + "c,1,4,False,0,0,0\nc,2,4,False,0,0,0\nc,4,8,False,0,0,0\nc,6,3,False,0,0,0\ns,10\ni\n" +
         kPng2x1;
}
// As appendix A.15 writes it: four fields in the lines `c`.
inline std::string AppendixA15() {
  return kFigure18Lines + "c,1,4,False\nc,2,4,True\nc,4,8,False\nc,6,3,False\ns,10\ni\n" + kPng2x1;
}

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

}  // namespace rodeira::traffic_map
