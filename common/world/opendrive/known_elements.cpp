// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/known_elements.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace rodeira::opendrive {
namespace {

struct Row {
  std::string_view element, children, attributes, once;
};

// Of ASAM OpenDRIVE 1.4 to 1.8, and what 1.1 to 1.3 wrote that is still met. `parent/element` where the name has other
// meanings under other parents.
constexpr Row kRows[] = {
    {"OpenDRIVE", "header road controller junction junctionGroup station vmsGroup", "", "header"},
    {"header", "geoReference offset license defaultRegulations",
     "revMajor revMinor name version date north south east west vendor maxRoad maxJunc maxPrg",
     "geoReference offset license defaultRegulations"},
    {"header/offset", "", "x y z hdg", ""},
    {"license", "", "name resource spdxid text", ""},
    {"road", "link type planView elevationProfile lateralProfile lanes objects signals surface railroad",
     "name length id junction rule",
     "link planView elevationProfile lateralProfile lanes objects signals surface railroad"},
    {"road/link", "predecessor successor neighbor", "", "predecessor successor"},
    {"link/predecessor", "", "elementType elementId contactPoint elementS elementDir id layer", ""},
    {"link/successor", "", "elementType elementId contactPoint elementS elementDir id layer", ""},
    {"link/neighbor", "", "side elementId direction", ""},
    {"road/type", "speed", "s type country", ""},
    {"type/speed", "", "max unit", ""},
    {"planView", "geometry", "", ""},
    {"geometry", "line spiral arc poly3 paramPoly3", "s x y hdg length", "line spiral arc poly3 paramPoly3"},
    {"geometry/line", "", "", ""},
    {"spiral", "", "curvStart curvEnd", ""},
    {"arc", "", "curvature", ""},
    {"poly3", "", "a b c d", ""},
    {"paramPoly3", "", "aU bU cU dU aV bV cV dV pRange", ""},
    {"elevationProfile", "elevation", "", ""},
    {"elevationProfile/elevation", "", "s a b c d", ""},
    {"lateralProfile", "superelevation crossfall shape crossSectionSurface", "", ""},
    {"superelevation", "", "s a b c d", ""},
    {"crossfall", "", "side s a b c d", ""},
    {"shape", "", "s t a b c d", ""},
    {"lanes", "laneOffset laneSection", "layer", ""},
    {"laneOffset", "", "s a b c d", ""},
    {"laneSection", "left center right", "s length singleSide", "left center right"},
    {"left", "lane", "", ""},
    {"center", "lane", "", "lane"},
    {"right", "lane", "", ""},
    {"lane", "link width border roadMark material speed access height rule visibility",
     "id type level direction advisory dynamicLaneDirection dynamicLaneType roadWorks layer overlapZone roadMarkRef",
     "link"},
    {"lane/link", "predecessor successor", "", ""},
    {"lane/width", "", "sOffset a b c d", ""},
    {"lane/border", "", "sOffset a b c d", ""},
    {"roadMark", "sway type explicit", "sOffset type weight color material width laneChange height", "type explicit"},
    {"sway", "", "ds a b c d", ""},
    {"roadMark/type", "line", "name width", ""},
    {"type/line", "", "length space tOffset sOffset rule width color", ""},
    {"explicit", "line", "", ""},
    {"explicit/line", "", "length space tOffset sOffset rule width color", ""},
    {"lane/material", "", "sOffset surface friction roughness", ""},
    {"lane/speed", "", "sOffset max unit", ""},
    {"lane/access", "restriction", "sOffset rule restriction", ""},
    {"access/restriction", "", "type", ""},
    {"lane/height", "", "sOffset inner outer", ""},
    {"lane/rule", "", "sOffset value", ""},
    {"lane/visibility", "", "sOffset forward back left right", ""},
    {"objects", "object objectReference tunnel bridge", "", ""},
    {"object", "repeat outline outlines material validity parkingSpace markings borders surface skeleton",
     "type subtype dynamic name id s t zOffset validLength orientation hdg pitch roll height length width radius "
     "perpToRoad temporary",
     "outlines markings borders parkingSpace skeleton surface"},
    {"repeat", "",
     "s length distance tStart tEnd widthStart widthEnd heightStart heightEnd zOffsetStart zOffsetEnd lengthStart "
     "lengthEnd radiusStart radiusEnd detachFromReferenceLine",
     ""},
    {"outlines", "outline", "", ""},
    {"outline", "cornerRoad cornerLocal", "id fillType outer closed laneType", ""},
    {"cornerRoad", "", "s t dz height id", ""},
    {"cornerLocal", "", "u v z height id", ""},
    {"object/material", "", "surface friction roughness roadMarkColor", ""},
    {"object/validity", "", "fromLane toLane layer", ""},
    {"markings", "marking", "", ""},
    {"markings/marking", "cornerReference",
     "side weight width color zOffset spaceLength lineLength startOffset stopOffset", ""},
    {"cornerReference", "", "id", ""},
    {"parkingSpace", "", "access restrictions", ""},
    {"borders", "border", "", ""},
    {"borders/border", "cornerReference", "width type outlineId useCompleteOutline", ""},
    {"skeleton", "polyline", "", ""},
    {"polyline", "vertexRoad vertexLocal", "id", ""},
    {"vertexRoad", "", "s t dz id radius width length height intersectionPoint", ""},
    {"vertexLocal", "", "u v z id radius width length height intersectionPoint", ""},
    {"objectReference", "validity", "s t id zOffset validLength orientation", ""},
    {"objectReference/validity", "", "fromLane toLane layer", ""},
    {"tunnel", "validity", "s length name id type lighting daylight", ""},
    {"tunnel/validity", "", "fromLane toLane layer", ""},
    {"bridge", "validity", "s length name id type", ""},
    {"bridge/validity", "", "fromLane toLane layer", ""},
    {"signals", "signal signalReference", "", ""},
    {"signal", "validity dependency reference positionRoad positionInertial semantics staticBoard vmsBoard",
     "s t id name dynamic orientation zOffset country countryRevision type subtype value unit height width length text "
     "hOffset pitch roll temporary",
     "positionRoad positionInertial"},
    {"staticBoard", "sign", "", ""},
    {"sign", "validity dependency signalDependency reference semantics",
     "v z id name dynamic orientation country countryRevision type subtype value unit height width length text hOffset "
     "pitch roll s t zOffset",
     ""},
    {"vmsBoard", "displayArea", "displayType displayWidth displayHeight v z material", ""},
    {"displayArea", "validity signalDependency", "index v z width height", ""},
    {"sign/validity", "", "fromLane toLane layer", ""},
    {"signal/validity", "", "fromLane toLane layer", ""},
    {"dependency", "", "id type", ""},
    {"positionRoad", "", "roadId s t zOffset hOffset pitch roll", ""},
    {"positionInertial", "", "x y z hdg pitch roll", ""},
    {"semantics",
     "speed lane priority prohibited warning routing streetName parking tourist supplementaryTime supplementaryAllows "
     "supplementaryProhibits supplementaryDistance supplementaryEnvironment supplementaryExplanatory",
     "", ""},
    {"semantics/priority", "", "type", ""},
    {"signalReference", "validity", "s t id orientation", ""},
    {"signalReference/validity", "", "fromLane toLane layer", ""},
    {"road/surface", "CRG", "", ""},
    {"surface/CRG", "",
     "file sStart sEnd orientation mode purpose sOffset tOffset zOffset zScale hOffset hideRoadSurfaceCRG", ""},
    {"OpenDRIVE/controller", "control", "id name sequence", ""},
    {"control", "", "signalId type", ""},
    {"junction", "connection priority controller surface planView elevationGrid boundary crossPath roadSection objects",
     "name id type orientation sStart sEnd mainRoad", "planView elevationGrid boundary"},
    {"connection", "predecessor successor laneLink", "id incomingRoad connectingRoad contactPoint type linkedRoad", ""},
    {"connection/predecessor", "", "elementType elementId elementS elementDir", ""},
    {"connection/successor", "", "elementType elementId elementS elementDir", ""},
    {"laneLink", "", "from to overlapZone fromLayer toLayer", ""},
    {"priority", "", "high low", ""},
    {"junction/controller", "", "id type sequence", ""},
    {"crossPath", "startLaneLink endLaneLink", "crossingRoad id roadAtStart roadAtEnd", "startLaneLink endLaneLink"},
    {"startLaneLink", "", "s from to", ""},
    {"endLaneLink", "", "s from to", ""},
    {"roadSection", "", "id roadId sStart sEnd", ""},
    {"boundary", "segment", "", ""},
};

// Of any element. What users and tools add for themselves is theirs.
constexpr std::string_view kAnywhere = "userData include dataQuality";

struct Choice {
  std::string_view parent, element, attribute, words;  // separated by '|'
};
constexpr Choice kChoices[] = {
    {"road", "lanes", "layer", "permanent|temporary"},
    {"lane", "roadMark", "type",
     "none|solid|broken|solid solid|solid broken|broken solid|broken broken|botts dots|grass|curb|custom|edge"},
    {"lane", "roadMark", "color", "standard|white|yellow|red|blue|green|orange|violet|black"},
    {"lane", "roadMark", "weight", "standard|bold"},
    {"lane", "roadMark", "laneChange", "increase|decrease|both|none"},
    {"type", "line", "rule", "no passing|caution|none"},
    {"explicit", "line", "rule", "no passing|caution|none"},
    {"type", "line", "color", "standard|white|yellow|red|blue|green|orange|violet|black"},
    {"explicit", "line", "color", "standard|white|yellow|red|blue|green|orange|violet|black"},
    {"lane", "access", "rule", "allow|deny"},
    {"objects", "object", "orientation", "+|-|none"},
    {"signals", "signal", "orientation", "+|-|none"},
    {"signals", "signal", "dynamic", "yes|no"},
    {"OpenDRIVE", "junction", "type", "default|virtual|direct|crossing|common"},
    {"junction", "connection", "contactPoint", "start|end"},
    {"OpenDRIVE", "road", "rule", "RHT|LHT"},
    {"outlines", "outline", "fillType", "grass|concrete|cobble|asphalt|pavement|gravel|soil|paint"},
    {"object", "outline", "fillType", "grass|concrete|cobble|asphalt|pavement|gravel|soil|paint"},
    {"object", "material", "roadMarkColor", "standard|white|yellow|red|blue|green|orange|violet|black"},
    {"object", "parkingSpace", "access", "all|bus|car|electric|handicapped|residents|truck|women"},
    {"semantics", "priority", "type",
     "4way|keepClearLine|noParkingLine|noTurnOnRed|priorityRoad|priorityRoadEnd|priorityToTheRightRule|stop|stopLine|"
     "turnOnRedAllowed|trafficLight|waitingLine|yield"},
    {"surface", "CRG", "orientation", "same|opposite"},
    {"surface", "CRG", "purpose", "elevation|friction"},
    {"surface", "CRG", "mode", "attached|attached0|genuine|global"},
};

std::vector<std::string> Split(std::string_view text, char at) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(at), text.size());
    if (end > 0) words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

using Table = std::map<std::string, KnownElement, std::less<>>;

const Table& Known() {
  static const Table table = [] {
    Table made;
    for (const Row& row : kRows) {
      KnownElement element{Split(row.children, ' '), Split(row.attributes, ' '), Split(row.once, ' ')};
      for (std::string& word : Split(kAnywhere, ' ')) element.children.push_back(std::move(word));
      made.emplace(row.element, std::move(element));
    }
    return made;
  }();
  return table;
}

}  // namespace

const KnownElement* FindKnown(std::string_view parent, std::string_view element) {
  const Table& known = Known();
  auto found = known.find(std::string(parent) + "/" + std::string(element));
  if (found == known.end()) found = known.find(element);
  return found == known.end() ? nullptr : &found->second;
}

std::vector<std::string> KnownNames() {
  std::set<std::string> names;
  for (const Row& row : kRows) {
    for (std::string& child : Split(row.children, ' ')) names.insert(std::move(child));
  }
  return {names.begin(), names.end()};
}

const std::vector<std::string>& WordsOf(std::string_view parent, std::string_view element, std::string_view attribute) {
  static const std::vector<std::vector<std::string>> words = [] {
    std::vector<std::vector<std::string>> made;
    for (const Choice& choice : kChoices) made.push_back(Split(choice.words, '|'));
    return made;
  }();
  static const std::vector<std::string> none;
  for (std::size_t i = 0; i < std::size(kChoices); ++i) {
    const Choice& choice = kChoices[i];
    if (choice.parent == parent && choice.element == element && choice.attribute == attribute) return words[i];
  }
  return none;
}

}  // namespace rodeira::opendrive
