// The stage: renderer, cameras, lights, floor. It draws when something changed, not all the time.

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

/** Vertical angle of view [deg]. */
const FIELD = 28;

export type View = 'iso' | 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom';

/** From where a view looks, and what is up in it. */
const VIEWS: Record<View, { from: [number, number, number]; up: [number, number, number] }> = {
  iso: { from: [1.15, -1.5, 0.85], up: [0, 0, 1] },
  front: { from: [0, -1, 0], up: [0, 0, 1] },
  back: { from: [0, 1, 0], up: [0, 0, 1] },
  left: { from: [-1, 0, 0], up: [0, 0, 1] },
  right: { from: [1, 0, 0], up: [0, 0, 1] },
  top: { from: [0, 0, 1], up: [0, 1, 0] },
  bottom: { from: [0, 0, -1], up: [0, -1, 0] },
};

export interface Tones {
  background: string;
  floor: string;
  floorLine: string;
}

export class Viewer {
  readonly scene = new THREE.Scene();
  readonly renderer: THREE.WebGLRenderer;
  readonly #perspective = new THREE.PerspectiveCamera(FIELD, 1, 0.01, 100);
  readonly #orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -100, 100);
  readonly #parent: HTMLElement;
  #camera: THREE.PerspectiveCamera | THREE.OrthographicCamera = this.#perspective;
  #controls: OrbitControls;
  #floor: THREE.GridHelper | null = null;
  #floorAt: { level: number; size: number; down: THREE.Vector3; centre: THREE.Vector3 } | null = null;
  #tones: Tones = { background: '#ffffff', floor: '#cccccc', floorLine: '#dddddd' };
  #due = false;
  #points: readonly THREE.Vector3[] = [new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1)];
  /** Called before each picture, with its camera. */
  onframe: () => void = () => {};
  /** Called when the camera moved. */
  onmove: () => void = () => {};

  constructor(parent: HTMLElement) {
    this.#parent = parent;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: false });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    parent.append(this.renderer.domElement);
    const sky = new THREE.HemisphereLight('#ffffff', '#8f959f', 1.9);
    sky.position.set(0, 0, 1);
    const key = new THREE.DirectionalLight('#ffffff', 1.7);
    key.position.set(0.6, -1, 1.4);
    this.scene.add(sky, key);
    this.#controls = this.#controlled();
    this.look('iso');
    new ResizeObserver(() => this.#fit()).observe(parent);
    this.#fit();
  }

  get camera(): THREE.Camera {
    return this.#camera;
  }

  get controls(): OrbitControls {
    return this.#controls;
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  get isOrthographic(): boolean {
    return this.#camera === this.#orthographic;
  }

  /** Width and height of the canvas in CSS pixels, kept: to ask for them while one drags would lay out the page each time. */
  extent: [number, number] = [1, 1];

  /** Asks for a picture; many asks before the next frame make one. */
  draw(): void {
    if (!this.#due) {
      this.#due = true;
      requestAnimationFrame(() => {
        if (this.#due) {
          this.#render();
        }
      });
    }
  }

  /** Draws at once. */
  now(): void {
    this.#render();
  }

  #render(): void {
    this.#due = false;
    this.#controls.update();
    this.onframe();
    this.renderer.render(this.scene, this.#camera);
  }

  /** A picture of the canvas as it stands, `scale` times as many pixels. */
  async png(scale: number): Promise<Blob | null> {
    const ratio = this.renderer.getPixelRatio();
    this.renderer.setPixelRatio(Math.min(scale * ratio, 4));
    this.renderer.render(this.scene, this.#camera);
    const blob = new Promise<Blob | null>((done) => this.canvas.toBlob(done, 'image/png'));
    this.renderer.setPixelRatio(ratio);
    this.draw();
    return blob;
  }

  tones(tones: Tones): void {
    this.#tones = tones;
    this.scene.background = new THREE.Color(tones.background);
    this.#lay();
    this.draw();
  }

  /** What pictures are to show. */
  bounds(points: readonly THREE.Vector3[], floor: { level: number; size: number; down: THREE.Vector3; centre: THREE.Vector3 }): void {
    this.#points = points;
    this.#floorAt = floor;
    this.#lay();
  }

  #lay(): void {
    if (this.#floor) {
      this.scene.remove(this.#floor);
      this.#floor.dispose();
      this.#floor = null;
    }
    if (this.#floorAt) {
      const { level, size, down, centre } = this.#floorAt;
      const step = niceStep(size / 8);
      const cells = 2 * Math.ceil((1.7 * size) / step);
      const floor = new THREE.GridHelper(cells * step, cells, this.#tones.floor, this.#tones.floorLine);
      floor.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), down);
      // On multiples of its step, so that its lines mean something.
      floor.position.copy(centre).divideScalar(step).round().multiplyScalar(step);
      floor.position.addScaledVector(down, level - floor.position.dot(down));
      floor.visible = this.floorShown;
      this.#floor = floor;
      this.scene.add(floor);
    }
  }

  #floorShown = true;
  get floorShown(): boolean {
    return this.#floorShown;
  }

  set floorShown(shown: boolean) {
    this.#floorShown = shown;
    if (this.#floor) {
      this.#floor.visible = shown;
    }
    this.draw();
  }

  /** Looks at all from a side. */
  look(view: View): void {
    const { from, up } = VIEWS[view];
    this.#camera.up.set(...up);
    this.#controls.dispose();
    this.#controls = this.#controlled();
    this.#frame(new THREE.Vector3(...from).normalize());
    this.draw();
  }

  /** All in view again, from where one looks. */
  fit(): void {
    this.#frame(this.#camera.position.clone().sub(this.#controls.target).normalize());
    this.draw();
  }

  /** Brings all points, seen along `way`, to fill the canvas below its buttons. */
  #frame(way: THREE.Vector3): void {
    const right = this.#camera.up.clone().cross(way).normalize();
    const up = way.clone().cross(right);
    const span = (axis: THREE.Vector3): [number, number] => {
      const along = this.#points.map((point) => point.dot(axis));
      return [Math.min(...along), Math.max(...along)];
    };
    const [[left, rightmost], [low, high], [far, near]] = [span(right), span(up), span(way)];
    const [width, height] = this.extent;
    const aspect = width / height;
    // Loads and buttons want some room above.
    const tall = 1.16 * Math.max(0.5 * (high - low) * 1.1, (0.5 * (rightmost - left)) / aspect, 1e-6);
    const centre = new THREE.Vector3()
      .addScaledVector(right, 0.5 * (left + rightmost))
      .addScaledVector(up, 0.5 * (low + high) + 0.05 * tall)
      .addScaledVector(way, 0.5 * (far + near));
    const tangent = Math.tan((FIELD * Math.PI) / 360);
    const distance = tall / tangent + 0.35 * (near - far);
    this.#controls.target.copy(centre);
    this.#camera.position.copy(centre).addScaledVector(way, distance);
    this.#perspective.near = distance / 200;
    this.#perspective.far = 20 * distance;
    this.#orthographic.near = -20 * distance;
    this.#orthographic.far = 20 * distance;
    this.#orthographic.zoom = 1;
    this.#tall = tall;
    this.#wide = aspect;
    this.#fit();
    this.#camera.lookAt(centre);
  }

  /** Half the height that is seen at the target, and the canvas's width over its height when that was chosen. */
  #tall = 1;
  #wide = 1;

  /** Changes between the cameras, keeping what is seen. */
  orthographic(on: boolean): void {
    const before = this.#camera;
    const after = on ? this.#orthographic : this.#perspective;
    if (before === after) {
      return;
    }
    const target = this.#controls.target.clone();
    const way = before.position.clone().sub(target);
    const tangent = Math.tan((FIELD * Math.PI) / 360);
    if (on) {
      this.#tall = way.length() * tangent;
      this.#orthographic.zoom = 1;
    } else {
      way.setLength(this.#tall / this.#orthographic.zoom / tangent);
    }
    after.up.copy(before.up);
    after.position.copy(target).add(way);
    this.#camera = after;
    this.#controls.dispose();
    this.#controls = this.#controlled();
    this.#controls.target.copy(target);
    this.#fit();
    after.lookAt(target);
    this.draw();
  }

  #controlled(): OrbitControls {
    const controls = new OrbitControls(this.#camera, this.renderer.domElement);
    controls.enableDamping = false;
    controls.zoomToCursor = true;
    controls.addEventListener('change', () => {
      this.onmove();
      this.draw();
    });
    return controls;
  }

  /** Turns the view by angles [rad], about the vertical and the horizontal. */
  orbit(right: number, up: number): void {
    const way = this.#camera.position.clone().sub(this.#controls.target);
    way.applyAxisAngle(this.#camera.up, right);
    const side = this.#camera.up.clone().cross(way).normalize();
    const turned = way.clone().applyAxisAngle(side, up);
    if (turned.angleTo(this.#camera.up) > 0.05 && turned.angleTo(this.#camera.up) < Math.PI - 0.05) {
      way.copy(turned);
    }
    this.#camera.position.copy(this.#controls.target).add(way);
    this.#camera.lookAt(this.#controls.target);
    this.onmove();
    this.draw();
  }

  /** Comes nearer (`factor` < 1) or goes away. */
  zoom(factor: number): void {
    if (this.#camera === this.#orthographic) {
      this.#orthographic.zoom /= factor;
      this.#orthographic.updateProjectionMatrix();
    } else {
      const way = this.#camera.position.clone().sub(this.#controls.target).multiplyScalar(factor);
      this.#camera.position.copy(this.#controls.target).add(way);
    }
    this.onmove();
    this.draw();
  }

  #fit(): void {
    this.extent = [this.#parent.clientWidth || 1, this.#parent.clientHeight || 1];
    const [width, height] = this.extent;
    this.renderer.setSize(width, height, false);
    const aspect = width / height;
    // A narrower canvas shows more above and below, so that what was in view stays in view.
    const more = Math.max(1, this.#wide / aspect);
    const tall = this.#tall * more;
    this.#perspective.fov = (360 / Math.PI) * Math.atan(more * Math.tan((FIELD * Math.PI) / 360));
    this.#perspective.aspect = aspect;
    this.#perspective.updateProjectionMatrix();
    const camera = this.#orthographic;
    [camera.left, camera.right, camera.top, camera.bottom] = [-tall * aspect, tall * aspect, tall, -tall];
    camera.updateProjectionMatrix();
    this.onmove();
    this.draw();
  }

  /** Where a point of the scene is on the canvas, in CSS pixels; the third is its depth, from −1 to 1 where it is seen. */
  project(point: THREE.Vector3): [number, number, number] {
    const [width, height] = this.extent;
    const at = point.clone().project(this.#camera);
    return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height, at.z];
  }

  /** Length in the scene of a pixel at a point. */
  pixel(point: THREE.Vector3): number {
    const height = this.extent[1];
    if (this.#camera === this.#orthographic) {
      return (2 * this.#orthographic.top) / this.#orthographic.zoom / height;
    }
    const distance = point.distanceTo(this.#camera.position);
    return (2 * distance * Math.tan((this.#perspective.fov * Math.PI) / 360)) / height;
  }

  /** The ray through a place on the canvas. */
  ray(x: number, y: number): THREE.Raycaster {
    const [width, height] = this.extent;
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.#camera);
    return caster;
  }
}

function niceStep(about: number): number {
  const power = 10 ** Math.floor(Math.log10(about));
  return power * ([1, 2, 5, 10].find((step) => step * power >= about) ?? 10);
}
