/** The list that the build makes of the files in `scenes/`. */
declare module "carom:scenes" {
  const scenes: import("./gallery.ts").Builtin[];
  export default scenes;
}
