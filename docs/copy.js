// A button on every block of commands copies what the reader types: lines that begin with "$ ", without the prompt.
document.querySelectorAll("pre > code").forEach((code) => {
  const commands = code.classList.contains("language-console");
  const lines = code.textContent.split("\n");
  const typed = [];
  let goesOn = false;
  for (const line of lines) {
    if (line.startsWith("$ ") || goesOn) {
      typed.push(line.startsWith("$ ") ? line.slice(2) : line);
      goesOn = line.trimEnd().endsWith("\\");
    }
  }
  const text = commands ? typed.join("\n") : code.textContent;
  if (!text.trim() || !navigator.clipboard) return;
  const button = document.createElement("button");
  button.type = "button";
  button.className = "copy";
  button.textContent = "Copy";
  button.setAttribute("aria-label", commands ? "Copy the commands" : "Copy the text");
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text.trimEnd() + "\n");
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = "Copy"), 1500);
  });
  code.parentElement.classList.add("has-copy");
  code.parentElement.append(button);
});
