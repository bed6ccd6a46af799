#pragma once

namespace softbody {

/// The elastic energy: corotated, or stable neo-Hookean (Smith, de Goes, Kim 2018), which only FEM offers.
enum class Elasticity { kCorotated, kNeoHookean };

}  // namespace softbody
