/* What a page without a kernel plays: the pictures that the panel showed, and when. */

/** @typedef {{drawing: string, facts: object[], spaces: object[], trouble: string}} Scene
 * @typedef {{began: number, length: number, scenes: Scene[], moments: [number, number, object][]}} History */

/** @param {History | undefined} history a panel that was saved by an older release has none @returns {Recording | null} */
export function recordingOf(history) {
  return history?.moments && history.moments.length > 1 ? new Recording(history) : null;
}

export class Recording {
  /** @param {History} history */
  constructor(history) {
    this.began = history.began; // s since the epoch
    this.length = history.length; // ms
    this.starts = history.moments.map(([at]) => at);
    this.moments = history.moments.map(([, scene, activity]) => ({ ...history.scenes[scene], scene, activity }));
  }

  /** What was to be seen at a time (ms). @param {number} time @returns {Scene & {scene: number, activity: object}} */
  at(time) {
    const next = this.starts.findIndex((start) => start > time);
    return this.moments[next < 0 ? this.moments.length - 1 : Math.max(next - 1, 0)];
  }

  /** That time in s since the epoch. @param {number} time */
  clock(time) {
    return this.began + time / 1000;
  }
}
