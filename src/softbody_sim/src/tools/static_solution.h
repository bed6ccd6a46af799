#pragma once

#include "softbody_sim/dynamics/simulator.h"
#include "tools/simulation_problem.h"

namespace softbody {

/// Number of tets that are turned inside out.
int invertedTets(const Points& vertices, const Tets& tets);

/// Brings a placed body to static equilibrium at the end of the problem's motions. Pins and obstacles move
/// there in steps of less than an edge, because a body that is torn apart at once may come to rest with
/// inverted tets. If the last step does not converge, or leaves more tets inverted than there were, the steps
/// get shorter.
/// @param settles_per_step in which a step may converge. @return of the last step; its iterations are those
/// of all.
StepReport settleInSteps(const SimulationProblem& problem, int settles_per_step, Simulator* simulator);

}  // namespace softbody
