// What Python says of an exercise (Exercise.as_data), and what is said to an answer.

export type Wrong = { name: string; hint: string; answer?: number | string };

type Known = { id: string; task: string; hints: string[]; wrong: Wrong[] };

/** A number, a size (its sign does not count), a word, or letters that name things. */
export type Value = Known & {
  kind: "numbers" | "size" | "word" | "letters";
  solution: number | string;
  also: (number | string)[];
  share: boolean;
  tolerance: number;
};

/** Code with blanks; of each line for a blank its mistake, null if it is right. */
export type Lines = Known & {
  kind: "lines";
  code: string;
  blanks: Record<string, [string, number | null][]>;
};

export type Task = Value | Lines;

/** An open exercise. */
export type Open = { id: string; kind: "open" };

export type Verdict = { name: string; text?: string; mistake?: number };

export type Reply = { name: string; text: string };
