within HydraulicTestBench;
package LoadCircuit "The test bench of two motors on a shaft: supply circuit, load circuit, controllers"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p><code>OpenTestBench</code> is the bench without controllers: commands of pump and servo valve in, speed and pressures
out. <code>TestBench</code> is that with the thesis' controllers: references in. <code>Rig</code> is the open bench with
its friction, for controllers outside of it, and <code>SampledTestBench</code> that with the sampled controllers of
<code>Controllers</code>.</p>
<p><b>Source:</b> thesis Chapter 5, Appendix G.</p>
</html>"));
end LoadCircuit;
