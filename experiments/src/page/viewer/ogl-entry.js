// The part of OGL that the viewer uses; bundled into ogl.min.js (README.md says how).
export { Camera, Geometry, Mesh, Program, Renderer, Transform, Vec3 } from "ogl";
