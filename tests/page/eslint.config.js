// The style of the page's modules and of what tests them, beyond what ESLint recommends.
import js from "@eslint/js";
import globals from "globals";

export default [
  js.configs.recommended,
  {
    languageOptions: { globals: globals.browser },
    rules: {
      "eqeqeq": ["error", "always", { null: "ignore" }],
      "no-implicit-coercion": "error",
      "no-shadow": "off",
      "no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "no-var": "error",
      "object-shorthand": "error",
      "prefer-const": ["error", { destructuring: "all" }],
      "max-lines": ["error", 250],
    },
  },
  { files: ["**/tests/**"], languageOptions: { globals: globals.node }, rules: { "max-lines": "off" } },
];
