// What a page has beside its modules: the tapes of live pages, and what tests ask.
declare const run: (...inputs: number[]) => number[];
declare const loads: ((x: number, out: number[]) => number[]) | undefined;
declare const centres: (x: number, out: number[]) => number[];
declare var planmethod: any;
declare var studio: any;
declare class CompressionStream { constructor(kind: string); readonly readable: ReadableStream; readonly writable: WritableStream }
declare class DecompressionStream extends CompressionStream {}
interface EventTarget { [key: string]: any }  // of the elements that listen
