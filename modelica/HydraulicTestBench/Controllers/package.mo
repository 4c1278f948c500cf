within HydraulicTestBench;
package Controllers "Sampled controllers: the blocks of a controller in Python, in Modelica"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Each is sampled every <code>dt</code> from the start on and holds its output in between. Each is the twin of a Python
block, from which it differs by rounding only, so that a bench with its controllers inside and a co-simulation with
controllers in Python can be compared sample by sample. <code>LoadCircuit.SpeedController</code> and
<code>LoadCircuit.LoadController</code> are the continuous forms.</p>
<p><b>Source:</b> thesis Section 5.4, Tables 12 and 13.</p>
</html>"));
end Controllers;
