#include "ros/drawing/body_material.h"

#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>
#include <OgreTextureUnitState.h>

#include <string>

namespace softbody {
namespace {

const std::string& group() { return Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME; }

// Light is computed per vertex: in software, the many small triangles of a fine mesh make pixels expensive.
// The lamp is a little above and beside the viewer, so that round shapes look round.
constexpr char kVertexShader[] = R"(#version 120
uniform mat4 to_screen;
uniform mat4 to_view;
uniform float alpha;
uniform float lit;
void main() {
  gl_Position = to_screen * gl_Vertex;
  gl_TexCoord[0] = gl_MultiTexCoord0;
  vec3 n = normalize(mat3(to_view) * gl_Normal);
  vec3 to_viewer = -normalize((to_view * gl_Vertex).xyz);
  vec3 to_lamp = normalize(to_viewer + vec3(-0.35, 0.45, 0.0));
  if (dot(n, to_viewer) < 0.0) n = -n;
  float facing = 0.5 + 0.5 * dot(n, to_lamp);
  float light = mix(1.0, 0.25 + 0.75 * facing * facing, lit);
  gl_FrontColor = vec4(gl_Color.rgb * light, alpha);
  gl_BackColor = gl_FrontColor;
})";

constexpr char kFaceShader[] = R"(#version 120
void main() { gl_FragColor = gl_Color; })";

constexpr char kTextureShader[] = R"(#version 120
uniform sampler2D image;
void main() { gl_FragColor = vec4(gl_Color.rgb * texture2D(image, gl_TexCoord[0].st).rgb, gl_Color.a); })";

constexpr char kEdgeShader[] = R"(#version 120
uniform vec4 color;
void main() { gl_FragColor = color; })";

std::string program(const char* name, Ogre::GpuProgramType type, const char* source) {
  auto& manager = Ogre::HighLevelGpuProgramManager::getSingleton();
  if (!manager.getByName(name, group())) {
    const auto made = manager.createProgram(name, group(), "glsl", type);
    made->setSource(source);
    made->load();
  }
  return name;
}

void setVertexProgram(Ogre::Pass* pass, const Look& look) {
  pass->setVertexProgram(program("softbody vertices", Ogre::GPT_VERTEX_PROGRAM, kVertexShader));
  const auto parameters = pass->getVertexProgramParameters();
  parameters->setNamedAutoConstant("to_screen", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  parameters->setNamedAutoConstant("to_view", Ogre::GpuProgramParameters::ACT_WORLDVIEW_MATRIX);
  parameters->setNamedConstant("alpha", Ogre::Real(look.alpha));
  parameters->setNamedConstant("lit", Ogre::Real(look.lit ? 1.0 : 0.0));
}

void setFlatColor(Ogre::Pass* pass, const Ogre::ColourValue& color) {
  pass->setFragmentProgram(program("softbody edges", Ogre::GPT_FRAGMENT_PROGRAM, kEdgeShader));
  pass->getFragmentProgramParameters()->setNamedConstant("color", color);
}

Ogre::Pass* addPass(Ogre::Technique* technique, const Look& look) {
  Ogre::Pass* pass = technique->createPass();
  pass->setLightingEnabled(false);
  pass->setCullingMode(look.closed ? Ogre::CULL_CLOCKWISE : Ogre::CULL_NONE);
  pass->setManualCullingMode(Ogre::MANUAL_CULL_NONE);
  if (look.alpha < 1.0) pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  return pass;
}

/// What is drawn later is drawn only on the nearest faces.
void addDepth(Ogre::Technique* technique, const Look& look) {
  Ogre::Pass* pass = addPass(technique, look);
  pass->setColourWriteEnabled(false);
  setVertexProgram(pass, look);
  setFlatColor(pass, look.edge_color);
}

void addFaces(Ogre::Technique* technique, const Look& look) {
  Ogre::Pass* pass = addPass(technique, look);
  setVertexProgram(pass, look);
  if (look.texture) {
    pass->setFragmentProgram(program("softbody texture", Ogre::GPT_FRAGMENT_PROGRAM, kTextureShader));
    pass->getFragmentProgramParameters()->setNamedConstant("image", 0);
    pass->createTextureUnitState()->setTexture(look.texture);
  } else {
    pass->setFragmentProgram(program("softbody faces", Ogre::GPT_FRAGMENT_PROGRAM, kFaceShader));
  }
}

void addEdges(Ogre::Technique* technique, const Look& look) {
  Ogre::Pass* pass = addPass(technique, look);
  pass->setPolygonMode(Ogre::PM_WIREFRAME);
  pass->setDepthBias(1.0f, 1.0f);
  setVertexProgram(pass, look);
  Ogre::ColourValue color = look.edge_color;
  color.a = static_cast<float>(look.alpha);
  setFlatColor(pass, color);
}

/// rviz draws with this scheme when it asks which vertex was picked: every triangle in the colour of its last
/// vertex.
void addPickTechnique(Ogre::Material* material) {
  Ogre::Technique* technique = material->createTechnique();
  technique->setSchemeName("Pick1");
  Ogre::Pass* pass = technique->createPass();
  pass->setLightingEnabled(false);
  pass->setCullingMode(Ogre::CULL_NONE);
  pass->setShadingMode(Ogre::SO_FLAT);
}

}  // namespace

BodyMaterial::BodyMaterial() {
  static int count = 0;
  material_ =
      Ogre::MaterialManager::getSingleton().create("softbody material " + std::to_string(count++), group());
  set({});
}

BodyMaterial::~BodyMaterial() { Ogre::MaterialManager::getSingleton().remove(material_); }

void BodyMaterial::set(const Look& look) {
  material_->removeAllTechniques();
  Ogre::Technique* technique = material_->createTechnique();
  if (look.style == Style::kEdges ? look.closed : look.alpha < 1.0) addDepth(technique, look);
  if (look.style != Style::kEdges) addFaces(technique, look);
  if (look.style != Style::kFaces) addEdges(technique, look);
  addPickTechnique(material_.get());
  material_->compile();
}

}  // namespace softbody
