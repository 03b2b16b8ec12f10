// What a page has beside its modules: the tapes of live pages, and what tests ask.
declare const run: (...inputs: number[]) => number[];
declare const loads: ((x: number, out: number[]) => number[]) | undefined;
declare const centres: (x: number, out: number[]) => number[];
declare var planmethod: any;
declare var studio: any;
interface EventTarget { [key: string]: any }  // of the elements that listen
