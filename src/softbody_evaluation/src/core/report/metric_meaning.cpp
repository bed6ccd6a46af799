#include "report/metric_meaning.h"

namespace softbody::evaluation {
namespace {

struct Meaning {
  const char* begin;  ///< of the metric's name
  const char* text;
};

/// The first that fits is taken.
constexpr Meaning kMeanings[] = {
    {"frames answered", "Frames for which the result has a surface."},
    {"frames with the true number of pieces", "Frames since the first cut with as many pieces as the truth."},
    {"frames ", "Frames in this state of the tracker."},
    {"vertex error", "Distance of every vertex from its true place."},
    {"visible vertices within", "Visible vertices that are as near as the tracker says; 90 is right."},
    {"visible vertices", "Distance from the true place, of the vertices that the camera sees."},
    {"hidden vertices within", "Hidden vertices that are as near as the tracker says; 90 is right."},
    {"hidden vertices", "Distance from the true place, of the vertices that the camera does not see."},
    {"vertices near a cut", "Distance from the true place, of the vertices beside a cut."},
    {"vertices in the right piece", "Vertices that are in the same piece as in the truth."},
    {"open loop", "Distance of every vertex from its true place, predicted without images."},
    {"surface distance", "Distance of places of the mesh from the nearest place of the true surface."},
    {"piece ", "Distance from the true place, of the vertices of one piece."},
    {"drift", "Error at the end, compared with the error at the start."},
    {"90 % bound over error", "Predicted bound over the true error; 1.63 is right."},
    {"cut surface, tilt", "Angle between the plane of the cut and the true plane."},
    {"cut surface, local angle", "Angle between the cut surface and the true one, at each place."},
    {"cut surface from", "Distance from the faces of the cut to the true ones."},
    {"true cut surface", "Distance from the true faces of the cut to those of the result."},
    {"hidden at", "An interval in which a part of the body was covered, and the time after it."},
    {"tool poses", "True poses of the tool for which the result has a pose."},
    {"tool position", "Distance of the tool from its true place."},
    {"tool rotation", "Angle between the tool and its true orientation."},
    {"jitter", "Motion of the vertices while the body stands still."},
    {"labels right", "Pixels around the body that have the true label: background, body or occluder."},
    {"force error", "Difference of the largest external force from the true one."},
    {"forces within 10 %", "Frames in which the largest external force is right."},
    {"place of the force", "Distance of the largest external force from its true place."},
    {"forces within their", "External forces within the bound that the result predicts; 90 % is right."},
    {"silhouette IoU", "Common pixels of mesh and body, over all pixels of either; 1 is best."},
    {"depth residual", "Distance along the camera's axis between the mesh and the measured depth."},
    {"depth within",
     "Pixels of the mesh whose measured depth is near; pixels of an occluder count as misses."},
    {"volume change by cuts", "Volume that the cuts took away, at rest."},
    {"volume change", "Volume of the mesh, compared with its volume at rest."},
    {"volume error", "Volume of the mesh, compared with the true volume."},
};

}  // namespace

std::string meaningOf(const std::string& name) {
  for (const Meaning& meaning : kMeanings) {
    if (name.rfind(meaning.begin, 0) == 0) return meaning.text;
  }
  return "Time of one stage of the tracker for one frame.";
}

}  // namespace softbody::evaluation
