/* What runs first in the frame that iframe-worker.js makes: what a worker has and a frame lacks. */
"use strict";
(() => {
  const worker = document.currentScript.dataset.worker;
  window.postMessage = (message, target) => parent.postMessage(message, target || "*");
  window.importScripts = (...urls) => urls.reduce((done, url) => done.then(() => new Promise(loaded => {
    const script = document.createElement("script");
    script.src = url;
    script.onload = loaded;
    document.body.appendChild(script);
  })), Promise.resolve());
  addEventListener("error", ({error}) => parent.dispatchEvent(new ErrorEvent("error", {filename: worker, error})));
})();
