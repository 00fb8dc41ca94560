// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// What stands on the stage: one or two necks, each with its outline at rest, arm, head and loads; light, camera, axes.

/** The colour scale from 0 to 1, as red, green and blue from 0 to 1, into target[at…]. */
flexneck.painter = (scale) => {
  const ramp = scale.map((colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255));
  return (share, target, at) => {
    const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
    const below = Math.min(Math.floor(place), ramp.length - 2);
    for (let part = 0; part < 3; ++part) {
      target[at + part] = ramp[below][part] + (place - below) * (ramp[below + 1][part] - ramp[below][part]);
    }
  };
};

/** A neck that can be moved, with what belongs to it, in the group `root`. */
flexneck.Actor = class {
  constructor(body) {
    const {data, positions, length} = body;
    const {unpack} = flexneck;
    this.body = body;
    this.paint = flexneck.painter(data.scale);
    this.root = new THREE.Group();
    this.moved = new THREE.BufferAttribute(Float32Array.from(positions), 3);
    this.colours = new THREE.BufferAttribute(new Float32Array(positions.length), 3);
    this.neck = new THREE.Group();
    const surface = new THREE.BufferGeometry();
    surface.setAttribute('position', this.moved);
    surface.setAttribute('color', this.colours);
    surface.setIndex(new THREE.BufferAttribute(unpack(data.surface.triangles, Uint32Array), 1));
    const skin = new THREE.Mesh(surface, new THREE.MeshPhongMaterial({
      vertexColors: THREE.VertexColors, flatShading: true, side: THREE.DoubleSide, shininess: 8,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    const linesOf = (pairs, opacity) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', this.moved);
      geometry.setIndex(new THREE.BufferAttribute(unpack(pairs, Uint32Array), 1));
      return new THREE.LineSegments(
          geometry, new THREE.LineBasicMaterial({color: 0x101418, opacity, transparent: true}));
    };
    const outlines = linesOf(data.surface.outlines, 0.9);
    this.edges = linesOf(data.surface.edges, 0.35);
    for (const object of [skin, outlines, this.edges]) {
      object.frustumCulled = false;
      this.neck.add(object);
    }
    // The undeformed neck beside a mode.
    this.ghost = new THREE.LineSegments(
        new THREE.BufferGeometry(),
        new THREE.LineBasicMaterial({color: 0x808890, opacity: 0.5, transparent: true}));
    this.ghost.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    this.ghost.geometry.setIndex(outlines.geometry.index);
    const solid = (geometry, colour) => new THREE.Mesh(
        geometry, new THREE.MeshPhongMaterial({color: colour, flatShading: false, shininess: 20}));
    this.arm = new THREE.Group();
    const post = solid(new THREE.BoxBufferGeometry(0.4 * length, 0.4 * length, 1.2 * length), 0x7d8794);
    post.position.z = -0.6 * length;
    this.arm.add(post);
    this.head = new THREE.Group();
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
      this.head.add(ball, centre);
    }
    this.loads = new THREE.Group();
    this.root.add(this.neck, this.ghost, this.arm, this.head, this.loads);
  }

  /** As a source wants it before it draws. */
  reset(source) {
    this.ghost.visible = source.kind === 'mode';
    this.arm.visible = source.kind !== 'mode';
    this.head.visible = Boolean(source.hasHead);
    this.loads.visible = Boolean(source.hasLoad);
    this.neck.position.set(0, 0, 0);
    this.neck.quaternion.set(0, 0, 0, 1);
  }

  /** Displacements of all vertices; the largest has the scale's upper end. */
  show(displacement, most) {
    const {positions} = this.body;
    for (let i = 0; i < displacement.length; i += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        this.moved.array[i + axis] = positions[i + axis] + displacement[i + axis];
      }
      const size = Math.hypot(displacement[i], displacement[i + 1], displacement[i + 2]);
      this.paint(most > 0 ? size / most : 0, this.colours.array, i);
    }
    this.moved.needsUpdate = true;
    this.colours.needsUpdate = true;
  }

  place(part, poses, frame) {
    const [x, y, z, qw, qx, qy, qz] = poses.subarray(7 * frame, 7 * frame + 7);
    this[part].position.set(x, y, z);
    this[part].quaternion.set(qx, qy, qz, qw);
  }

  /** Arrows from where the loads act: place and components of each. */
  drawLoads(loads, strongest) {
    while (this.loads.children.length < loads.length) this.loads.add(flexneck.makeArrow(0xd55e00));
    loads.forEach((row, k) => {
      const arrow = this.loads.children[k];
      const force = new THREE.Vector3(...row.subarray(3, 6));
      const share = force.length() / strongest;
      arrow.visible = share > 0.01;
      if (!arrow.visible) return;
      arrow.position.set(...row.subarray(0, 3));
      arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.normalize());
      const [length, width] = [0.9 * this.body.length * share, this.body.length * Math.max(share, 0.3)];
      arrow.scale.set(width, length, width);
    });
  }
};

/** Along y, of length 1, seen through what stands before it. */
flexneck.makeArrow = (colour) => {
  const material = new THREE.MeshBasicMaterial({color: colour, depthTest: false});
  const part = (geometry, place) => {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.y = place;
    mesh.renderOrder = 2;
    return mesh;
  };
  const arrow = new THREE.Group();
  arrow.add(part(new THREE.CylinderBufferGeometry(0.014, 0.014, 0.8, 12), 0.4),
            part(new THREE.ConeBufferGeometry(0.045, 0.2, 16), 0.9));
  return arrow;
};

/** Null where there is no WebGL. @param length  that the picture is made for, m */
flexneck.makeStage = (length, canvas) => {
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer(
        {canvas, alpha: true, antialias: true, preserveDrawingBuffer: true});  // kept for print
  } catch (error) {
    return null;
  }
  renderer.autoClear = false;
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(30, 1, length / 100, length * 200);
  camera.up.set(0, 0, 1);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a99, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.45);
  camera.add(lamp);
  lamp.position.set(-1, 1, 1);
  scene.add(camera);
  const {triad, camera: triadCamera} = flexneck.makeTriad();
  return {
    renderer, scene, camera,
    render() {
      const size = renderer.getSize(new THREE.Vector2());
      renderer.setViewport(0, 0, size.x, size.y);
      renderer.clear();
      renderer.render(scene, camera);
      triadCamera.position.set(0, 0, 4).applyQuaternion(camera.quaternion);
      triadCamera.quaternion.copy(camera.quaternion);
      renderer.clearDepth();
      renderer.setViewport(4, 4, 96, 96);
      renderer.render(triad, triadCamera);
    },
  };
};

/** The world's axes for a corner of the picture: x forward, y to the left, z upwards. */
flexneck.makeTriad = () => {
  const triad = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-1.5, 1.5, 1.5, -1.5, 0.1, 10);
  const axes = {x: [0xd55e00, [1, 0, 0]], y: [0x009e73, [0, 1, 0]], z: [0x3d8fd1, [0, 0, 1]]};
  for (const [name, [colour, direction]] of Object.entries(axes)) {
    const along = new THREE.Vector3(...direction);
    triad.add(new THREE.ArrowHelper(along, new THREE.Vector3(), 1, colour, 0.3, 0.18));
    const letter = flexneck.element('canvas', {width: 64, height: 64});
    const context = letter.getContext('2d');
    context.font = 'bold 52px sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillStyle = `#${colour.toString(16).padStart(6, '0')}`;
    context.fillText(name, 32, 32);
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: new THREE.CanvasTexture(letter), transparent: true}));
    sprite.scale.set(0.5, 0.5, 1);
    sprite.position.copy(along).multiplyScalar(1.25);
    triad.add(sprite);
  }
  return {triad, camera};
};
