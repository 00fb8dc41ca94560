// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// What stands on the stage: the neck, its outline at rest, the arm and the head, with camera and light.

/**
 * Of the skin's vertices at rest and the neck's length. The neck's positions and colours are the
 * attributes moved and colours. Null where there is no WebGL.
 */
flexneck.makeStage = (data, positions, length, canvas) => {
  const {unpack} = flexneck;
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer(
        {canvas, alpha: true, antialias: true, preserveDrawingBuffer: true});  // kept for print
  } catch (error) {
    return null;
  }
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(30, 1, length / 100, length * 100);
  camera.up.set(0, 0, 1);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a99, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.45);
  camera.add(lamp);
  lamp.position.set(-1, 1, 1);
  scene.add(camera);

  const moved = new THREE.BufferAttribute(Float32Array.from(positions), 3);
  const colours = new THREE.BufferAttribute(new Float32Array(positions.length), 3);
  const neck = new THREE.Group();
  const surface = new THREE.BufferGeometry();
  surface.setAttribute('position', moved);
  surface.setAttribute('color', colours);
  surface.setIndex(new THREE.BufferAttribute(unpack(data.surface.triangles, Uint32Array), 1));
  const skin = new THREE.Mesh(surface, new THREE.MeshPhongMaterial({
    vertexColors: THREE.VertexColors, flatShading: true, side: THREE.DoubleSide, shininess: 8,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
  const linesOf = (pairs, opacity) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', moved);
    geometry.setIndex(new THREE.BufferAttribute(unpack(pairs, Uint32Array), 1));
    return new THREE.LineSegments(
        geometry, new THREE.LineBasicMaterial({color: 0x101418, opacity, transparent: true}));
  };
  const outlines = linesOf(data.surface.outlines, 0.9);
  const edges = linesOf(data.surface.edges, 0.35);
  edges.visible = false;
  for (const object of [skin, outlines, edges]) {
    object.frustumCulled = false;
    neck.add(object);
  }
  scene.add(neck);

  /** The undeformed neck beside a mode. */
  const ghost = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({color: 0x808890, opacity: 0.5, transparent: true}));
  ghost.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  ghost.geometry.setIndex(outlines.geometry.index);
  scene.add(ghost);

  const solid = (geometry, colour) => new THREE.Mesh(
      geometry, new THREE.MeshPhongMaterial({color: colour, flatShading: false, shininess: 20}));
  const arm = new THREE.Group();
  const post = solid(new THREE.BoxBufferGeometry(0.4 * length, 0.4 * length, 1.2 * length), 0x7d8794);
  post.position.z = -0.6 * length;
  arm.add(post);
  scene.add(arm);
  const head = new THREE.Group();
  if (data.head) {
    const ball = solid(new THREE.SphereBufferGeometry(1, 40, 24), 0xc9b8a0);
    ball.scale.set(...data.head.semiAxes);
    ball.position.set(...data.head.centre);
    const [w, x, y, z] = data.head.rotation;
    ball.quaternion.set(x, y, z, w);
    ball.material.transparent = true;
    ball.material.opacity = 0.55;
    ball.renderOrder = 1;
    const centre = solid(new THREE.SphereBufferGeometry(length / 40, 16, 12), 0x202020);
    centre.position.copy(ball.position);
    head.add(ball, centre);
  }
  scene.add(head);
  return {renderer, scene, camera, neck, edges, ghost, arm, head, moved, colours};
};
