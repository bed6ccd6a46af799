#pragma once

#include <string>

#include "corpus/mesh_mutations.h"
#include "report/model_verdict.h"

namespace softbody::test {

/// A model of one mesh, and whether it is what it must be.
struct CheckedMesh {
  std::string outcome;  ///< verdict, or the refusal
  double volume = 0.0;  ///< of the visual mesh of the model [m^3]
  double seconds = 0.0;
  std::string fault;  ///< empty: none
};

/// Prepares the mesh as prepare_model does. Of a good model, five more planes at places that the seed decides
/// must cut. @param scratch folder for files.
CheckedMesh checkMesh(const MutatedMesh& mesh, const std::string& scratch, unsigned seed);

}  // namespace softbody::test
