/* The recording that a page without a kernel plays: the states of the panel and their times. */

/** @typedef {{drawing: string, facts: object[], spaces: object[], trouble: string}} Scene
 * @typedef {{began: number, length: number, scenes: Scene[], moments: [number, number, object][]}} History */

/** @param {History | undefined} history missing in a panel that an older release saved @returns {Recording | null} */
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

  /** Returns the state of the panel at a time (ms). @param {number} time @returns {Scene & {scene: number, activity:
   * object}} */
  at(time) {
    const next = this.starts.findIndex((start) => start > time);
    return this.moments[next < 0 ? this.moments.length - 1 : Math.max(next - 1, 0)];
  }

  /** Converts a time of the recording (ms) to s since the epoch. @param {number} time */
  clock(time) {
    return this.began + time / 1000;
  }
}
